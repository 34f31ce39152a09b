#include <CLI/CLI.hpp>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <numbers>
#include <sstream>

#include "kernels/water/refraction/path_table.h"
#include "kernels/water/refraction/thermocline.h"
#include "tools/physics/verb.h"

namespace ensonify::physics {
namespace {

using refraction::Knot;
using refraction::PathEnd;
using refraction::SoundSpeedProfile;

constexpr double kDeg = std::numbers::pi / 180.0;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

enum class Water { kThermocline, kLinear, kProfile };
enum class Until { kDepth, kTime, kDistance, kPoint };
enum class Method { kExact, kTable };

struct Inputs {
  Water water = Water::kThermocline;
  Until until = Until::kDepth;
  Method method = Method::kExact;
  double surface_speed_mps = 1500.0;
  double gradient_per_s = 0.016;
  double source_depth_m = 0.0;
  double depression_deg = 30.0;
  double target_depth_m = 80.0;
  double time_s = 0.1;
  double distance_m = 100.0;
  double most_turns = 1;
  std::string profile;  // a file
};

/// Lines of depth and speed, between commas, blanks or semicolons. Lines that do not begin with a number are titles.
SoundSpeedProfile read_profile(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::invalid_argument("--profile: cannot read '" + path + "'");
  std::vector<Knot> knots;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    for (char& letter : line) letter = letter == ',' || letter == ';' ? ' ' : letter;
    std::istringstream words(line);
    Knot knot{};
    if (!(words >> knot.depth_m)) continue;
    if (!(words >> knot.speed_mps)) {
      throw std::invalid_argument(path + ":" + std::to_string(number) + ": a depth without a speed");
    }
    knots.push_back(knot);
  }
  return SoundSpeedProfile(std::move(knots));
}

SoundSpeedProfile profile_of(const Inputs& in) {
  if (in.water == Water::kProfile) {
    if (in.profile.empty()) throw std::invalid_argument("--water profile: needs --profile and a file");
    return read_profile(in.profile);
  }
  if (in.water == Water::kThermocline) return refraction::summer_thermocline();
  constexpr double kDeep_m = 1000.0;
  return SoundSpeedProfile(
      {{0.0, in.surface_speed_mps}, {kDeep_m, in.surface_speed_mps + in.gradient_per_s * kDeep_m}});
}

std::optional<PathEnd> to_depth(const Inputs& in, const SoundSpeedProfile& water, double launch_rad) {
  if (in.method == Method::kTable) {
    refraction::PathTable table;
    table.build(water, in.source_depth_m, in.target_depth_m);
    return table.at(launch_rad, in.target_depth_m);
  }
  return path_to_depth(water, in.source_depth_m, launch_rad, in.target_depth_m,
                       static_cast<int>(std::lround(in.most_turns)));
}

Verb::Row row_of(const Inputs& in) {
  const SoundSpeedProfile water = profile_of(in);
  double launch_rad = in.depression_deg * kDeg;
  std::optional<PathEnd> end;
  switch (in.until) {
    case Until::kDepth: end = to_depth(in, water, launch_rad); break;
    case Until::kTime: end = path_at_time(water, in.source_depth_m, launch_rad, in.time_s); break;
    case Until::kDistance: end = path_at_horizontal(water, in.source_depth_m, launch_rad, in.distance_m); break;
    case Until::kPoint: {
      const auto ray = eigenray(water, in.source_depth_m, in.distance_m, in.target_depth_m);
      launch_rad = ray ? ray->launch_depression_rad : kNone;
      if (ray) end = ray->end;
      break;
    }
  }
  if (!end) return Verb::Row(10, kNone);
  return {launch_rad / kDeg,
          end->horizontal_m,
          end->depth_m,
          end->depression_rad / kDeg,
          end->travel_time_s,
          end->path_length_m,
          end->tube_m2,
          end->horizontal_per_rad_m,
          static_cast<double>(end->turns),
          end->turns > 0 ? end->turning_depth_m : kNone};
}

}  // namespace

void add_ray(CLI::App& app, Verbs& verbs) {
  Verb& verb = verbs.emplace_back(
      app, "ray", "the bent path of sound through layers: where it ends, when, and how its bundle spreads");
  const auto in = std::make_shared<Inputs>();
  verb.choice("water", in->water,
              {{"thermocline", Water::kThermocline}, {"linear", Water::kLinear}, {"profile", Water::kProfile}},
              "an example of ten layers over 80 m, speed linear in depth, or the file of --profile");
  verb.choice(
      "until", in->until,
      {{"depth", Until::kDepth}, {"time", Until::kTime}, {"distance", Until::kDistance}, {"point", Until::kPoint}},
      "where the path ends: point finds the launch that reaches the target depth at the distance");
  verb.choice("method", in->method, {{"exact", Method::kExact}, {"table", Method::kTable}},
              "exact arcs, or (until depth) the table that rays of a ping use");
  verb.number("surface_speed_mps", in->surface_speed_mps, SoundSpeedProfile::kSlowest_mps,
              SoundSpeedProfile::kFastest_mps, "speed at the surface, for linear water");
  verb.number("gradient_per_s", in->gradient_per_s, -0.4, 0.4, "its growth with depth, down to 1000 m");
  verb.number("source_depth_m", in->source_depth_m, 0, 12000, "depth of the source");
  verb.number("depression_deg", in->depression_deg, -90, 90, "launch angle below the horizontal");
  verb.number("target_depth_m", in->target_depth_m, 0, 12000, "depth of the end, for depth and point");
  verb.number("time_s", in->time_s, 0, 100, "one-way time, for time");
  verb.number("distance_m", in->distance_m, 0, 1e5, "horizontal distance, for distance and point");
  verb.number("most_turns", in->most_turns, 0, 1000, "how often the path may turn on its way to a depth");
  verb.options()
      .add_option("--profile", in->profile,
                  "file of the water: lines of depth in m and speed in m/s; chooses --water profile")
      ->each([&verb](const std::string&) { verb.choose("water", "profile"); });
  verb.results({"launch_deg", "horizontal_m", "depth_m", "arrival_deg", "travel_time_s", "path_length_m", "tube_m2",
                "horizontal_per_rad_m", "turns", "turning_depth_m"},
               [in] { return row_of(*in); });
}

}  // namespace ensonify::physics

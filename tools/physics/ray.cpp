#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "components/config/data_paths.h"
#include "kernels/water/refraction/path_table.h"
#include "kernels/water/refraction/thermocline.h"
#include "kernels/water/sound_speed.h"
#include "scenarios/world/cast.h"
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
  CastColumns columns;
};

/// A cast as scenarios read it; where it has no speeds they follow from temperature and salinity by Mackenzie's law.
SoundSpeedProfile read_profile(const std::string& path, const CastColumns& columns) {
  const std::string found = find_data(path, {""});
  std::vector<Knot> knots;
  for (const WaterSample& sample : read_cast(found.empty() ? path : found, columns)) {
    const double speed_mps =
        sample.sound_speed_mps
            ? *sample.sound_speed_mps
            : water::sound_speed_mps(water::SoundSpeedLaw::kMackenzie, sample.temperature_degc.value_or(0.0),
                                     sample.salinity_psu.value_or(0.0), sample.depth_m);
    knots.push_back({sample.depth_m, speed_mps});
  }
  return SoundSpeedProfile(std::move(knots));
}

SoundSpeedProfile profile_of(const Inputs& in) {
  if (in.water == Water::kProfile) {
    if (in.profile.empty()) throw std::invalid_argument("--water profile: needs --profile and a file");
    return read_profile(in.profile, in.columns);
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
      .add_option("--profile", in->profile, "file of the water, a cast as scenarios take it; chooses --water profile")
      ->each([&verb](const std::string&) { verb.choose("water", "profile"); });
  using Column = std::pair<const char*, std::string*>;
  for (const auto& [name, column] : {Column{"--depth-column", &in->columns.depth_m},
                                     {"--speed-column", &in->columns.sound_speed_mps},
                                     {"--temperature-column", &in->columns.temperature_degc},
                                     {"--salinity-column", &in->columns.salinity_psu}}) {
    verb.options()
        .add_option(name, *column, "what this column of the cast is called, or its number from 1")
        ->capture_default_str();
  }
  verb.results({"launch_deg", "horizontal_m", "depth_m", "arrival_deg", "travel_time_s", "path_length_m", "tube_m2",
                "horizontal_per_rad_m", "turns", "turning_depth_m"},
               [in] { return row_of(*in); });
}

}  // namespace ensonify::physics

// ensonify plan: surveys before they are run.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "components/errors/exit_error.h"
#include "components/runtime/tool.h"
#include "components/terrain/source_of.h"
#include "kernels/survey/lines.h"
#include "kernels/survey/spacing.h"
#include "scenarios/world/world.h"
#include "tools/plan/line_files.h"

namespace ensonify::plan {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// One `ensonify plan <verb>`: its command line, and what it does.
struct Verb {
  CLI::App* app;
  std::function<int()> run;
};

/// How a verb prints.
struct Form {
  bool json = false, csv = false;

  Format format() const { return json ? Format::kJson : csv ? Format::kCsv : Format::kYaml; }
  void add_flags(CLI::App* app) {
    app->add_flag("--json", json, "print JSON");
    app->add_flag("--csv", csv, "print CSV");
  }
};

/// An option with limits, whose default the help shows.
template <class T>
void number(CLI::App* app, const char* name, T& value, const char* about, T least, T most) {
  app->add_option(name, value, about)->check(CLI::Range(least, most))->capture_default_str();
}

struct Import : Form {
  std::string file, crs;
  std::optional<double> speed_mps;
};

int import(const Import& options) {
  const LineSet set = read_lines(options.file, options.crs);
  const Numbers numbers{{"lines", static_cast<double>(set.lines.size())}};
  fmt::print("{}", plan_text(set, numbers, options.speed_mps, options.format()));
  return kExitOk;
}

Verb add_import(CLI::App& parent) {
  auto options = std::make_shared<Import>();
  CLI::App* app = parent.add_subcommand(
      "import",
      "Reads lines that survey software wrote (.lnw, .csv, .geojson, .json, .kml, .gpx) and prints a mission.");
  app->add_option("file", options->file, "the file")->required();
  app->add_option("--crs", options->crs,
                  "reference system of projected places, e.g. EPSG:32629; without it they are world metres");
  app->add_option("--speed", options->speed_mps, "speed to run the lines at, m/s")->check(CLI::Range(0.01, 30.0));
  options->add_flags(app);
  return {app, [options] { return import(*options); }};
}

struct Lines : Form {
  std::vector<std::pair<double, double>> corners;
  std::string scenario;
  double depth_m = 0.0, head_depth_m = 0.0, spacing_m = 0.0;
  double heading_deg = 0.0, swath_deg = 120.0, overlap = 0.1, shortest_m = 10.0, row_m = 5.0;
  bool fixed = false, record_in_turns = false;
  survey::RunRules run;
  double megabytes_per_s = 0.0;
};

/// Depths below the head: of the scenario's seabed, or one depth.
survey::DepthAt depth_of(const Lines& o) {
  if (o.scenario.empty()) return [depth_m = o.depth_m - o.head_depth_m](const survey::Vec2&) { return depth_m; };
  const World world = read_world(o.scenario);
  const std::shared_ptr<source::TerrainSource> terrain = source::source_of({world.site, world.seabed, "", 1, {}});
  return [terrain, head_m = o.head_depth_m](const survey::Vec2& place) { return -terrain->height_m(place) - head_m; };
}

/// Full width of the swath over a line's middle.
double swath_m(const survey::Runline& line, const survey::DepthAt& depth, double swath_rad) {
  return 2.0 * std::tan(0.5 * swath_rad) * depth(0.5 * (line.start_enu_m + line.end_enu_m));
}

int lines(const Lines& o) {
  survey::Polygon area;
  for (const auto& [east_m, north_m] : o.corners) area.emplace_back(east_m, north_m);
  const survey::LayRules rules{
      o.heading_deg * kDegree, {0.5 * o.swath_deg * kDegree, o.overlap}, o.shortest_m, o.row_m};
  const survey::DepthAt depth = depth_of(o);
  const auto laid = o.spacing_m > 0.0 ? survey::spaced_lines(area, o.spacing_m, rules)
                    : o.fixed         ? survey::fixed_lines(area, depth, rules)
                                      : survey::adapted_lines(area, depth, rules);
  if (laid.empty()) throw UserError("no line of --shortest or more fits into the area");

  survey::RunRules run = o.run;
  run.data_bytes_per_s = 1e6 * o.megabytes_per_s;
  run.record_in_turns = o.record_in_turns;
  const survey::RunCost cost = survey::run_cost(laid, run);
  std::vector<double> swaths_m;
  for (const auto& line : laid) swaths_m.push_back(swath_m(line, depth, rules.swath.half_angle_rad * 2.0));
  const Numbers numbers{{"lines_count", static_cast<double>(laid.size())},
                        {"area_m2", survey::area_m2(area)},
                        {"line_m", cost.line_m},
                        {"turn_m", cost.turn_m},
                        {"line_s", cost.line_s},
                        {"turn_s", cost.turn_s},
                        {"total_s", cost.total_s},
                        {"redundancy", survey::redundancy(laid, swaths_m, survey::area_m2(area))},
                        {"data_gb", 1e-9 * cost.data_bytes},
                        {"cost", cost.cost}};
  LineSet set;
  for (const auto& line : laid) {
    set.lines.push_back({"", {{line.start_enu_m.x(), line.start_enu_m.y()}, {line.end_enu_m.x(), line.end_enu_m.y()}}});
  }
  fmt::print("{}", plan_text(set, numbers, run.speed_mps, o.format()));
  return kExitOk;
}

Verb add_lines(CLI::App& parent) {
  auto o = std::make_shared<Lines>();
  CLI::App* app = parent.add_subcommand(
      "lines",
      "Parallel lines over an area, each as far from the one before as the swath allows on the bottom there; with the "
      "time, data and cost that they take.");
  app->add_option("--corner", o->corners, "corner of the area, east and north in world metres; three or more")
      ->required();
  auto* scenario = app->add_option("--scenario", o->scenario,
                                   "scenario whose seabed gives the depths: a file, from here or the project's own");
  auto* depth = app->add_option("--depth", o->depth_m, "instead: one depth below chart datum, m");
  depth->check(CLI::Range(0.1, 11000.0));
  scenario->excludes(depth);
  number(app, "--head-depth", o->head_depth_m, "of the transducer below chart datum, m", 0.0, 11000.0);
  number(app, "--heading", o->heading_deg,
         "of the first line, degrees from grid north; the survey goes on to starboard", -360.0, 360.0);
  number(app, "--swath", o->swath_deg, "full angle that counts, degrees", 1.0, 160.0);
  number(app, "--overlap", o->overlap, "of a half swath with what is covered", 0.0, 0.9);
  app->add_option("--spacing", o->spacing_m, "instead of swath and overlap: distance between lines, m")
      ->check(CLI::Range(0.1, 1e5));
  app->add_flag("--fixed", o->fixed, "one distance between all lines, the one that the shallowest place asks for");
  number(app, "--shortest", o->shortest_m, "of a line, m", 1.0, 1e5);
  number(app, "--row", o->row_m, "distance along lines at which the bottom is sampled, m", 0.1, 1e4);
  number(app, "--speed", o->run.speed_mps, "on lines, m/s", 0.01, 30.0);
  number(app, "--turn-speed", o->run.turn_speed_mps, "m/s", 0.01, 30.0);
  number(app, "--turning-radius", o->run.turning_radius_m, "m", 0.1, 1e4);
  number(app, "--run-in", o->run.run_in_m, "m", 0.0, 1e4);
  number(app, "--run-out", o->run.run_out_m, "m", 0.0, 1e4);
  number(app, "--data-rate", o->megabytes_per_s, "of what is recorded, 1e6 bytes/s", 0.0, 1e6);
  app->add_flag("--record-in-turns", o->record_in_turns, "turns are recorded too");
  number(app, "--day-rate", o->run.cost_per_day, "cost of a day of 24 h, any currency", 0.0, 1e12);
  o->add_flags(app);
  return {app, [o, scenario, depth] {
            if (scenario->count() + depth->count() == 0) {
              throw UserError("no depths; allowed: --scenario FILE or --depth M");
            }
            return lines(*o);
          }};
}

struct Sidescan : Form {
  double range_m = 0.0, share = 0.1, least_m = 3.0, nadir_deg = 25.0, overlap = 0.1, object_m = 1.0;
};

int sidescan(const Sidescan& o) {
  const double altitude_m = survey::towfish_altitude_m(o.range_m, o.share, o.least_m);
  if (altitude_m >= o.range_m) throw UserError("--least: the altitude must be below --range");
  const auto swath = survey::sidescan_swath(altitude_m, o.range_m, o.nadir_deg * kDegree);
  if (swath.near_m >= swath.far_m) throw UserError("--nadir: the gap is wider than the range; allowed is less");
  fmt::print("{}", numbers_text({{"altitude_m", altitude_m},
                                 {"near_m", swath.near_m},
                                 {"far_m", swath.far_m},
                                 {"far_grazing_deg", swath.far_grazing_rad / kDegree},
                                 {"joining_spacing_m", survey::joining_spacing_m(swath, o.overlap)},
                                 {"gap_filling_spacing_m", survey::gap_filling_spacing_m(swath, o.overlap)},
                                 {"far_shadow_m", survey::shadow_m(o.object_m, altitude_m, swath.far_m)}},
                                o.format()));
  return kExitOk;
}

Verb add_sidescan(CLI::App& parent) {
  auto o = std::make_shared<Sidescan>();
  CLI::App* app = parent.add_subcommand("sidescan", "Altitude of a towfish and the distance of its lines.");
  app->add_option("--range", o->range_m, "slant range to either side, m")->check(CLI::Range(1.0, 5000.0))->required();
  number(app, "--share", o->share, "altitude over range", 0.01, 0.9);
  number(app, "--least", o->least_m, "altitude that obstacles ask for, m", 0.0, 1000.0);
  number(app, "--nadir", o->nadir_deg, "half angle of the gap below, degrees", 0.0, 80.0);
  number(app, "--overlap", o->overlap, "of neighbouring images", 0.0, 0.9);
  number(app, "--object", o->object_m, "height of an object whose shadow is printed, m", 0.0, 1000.0);
  o->add_flags(app);
  return {app, [o] { return sidescan(*o); }};
}

struct Speed : Form {
  double feature_m = 1.0, depth_m = 0.0, swath_deg = 120.0, beam_deg = 1.0, sound_speed_mps = 1500.0, dead_s = 0.0,
         highest_hz = 50.0;
  int pings = 3, beams = 256;
  bool touch = false;
};

int speed(const Speed& o) {
  const double tangent = std::tan(0.5 * o.swath_deg * kDegree);
  const double range_m = o.depth_m / std::cos(0.5 * o.swath_deg * kDegree);
  const double rate_hz = survey::ping_rate_hz(range_m, o.sound_speed_mps, o.dead_s, o.highest_hz);
  const double footprint_m = survey::footprint_m(o.depth_m, o.beam_deg * kDegree);
  const double beam_spacing_m = 2.0 * o.depth_m * tangent / o.beams;
  const double fastest_mps =
      survey::fastest_for_feature_mps(o.feature_m, o.touch ? footprint_m : 0.0, rate_hz, o.pings);
  fmt::print("{}", numbers_text({{"fastest_mps", fastest_mps},
                                 {"fastest_kn", fastest_mps * 3600.0 / 1852.0},
                                 {"ping_rate_hz", rate_hz},
                                 {"range_m", range_m},
                                 {"footprint_m", footprint_m},
                                 {"beam_spacing_m", beam_spacing_m},
                                 {"beams_across", survey::soundings_across(o.feature_m, beam_spacing_m)}},
                                o.format()));
  return kExitOk;
}

Verb add_speed(CLI::App& parent) {
  auto o = std::make_shared<Speed>();
  CLI::App* app = parent.add_subcommand("speed", "Highest speed over ground at which a feature gets its pings.");
  number(app, "--feature", o->feature_m, "its length along and width across the track, m", 0.01, 1000.0);
  number(app, "--pings", o->pings, "pings that must hit it", 1, 1000);
  app->add_option("--depth", o->depth_m, "of the bottom below the head, m")
      ->check(CLI::Range(0.1, 11000.0))
      ->required();
  number(app, "--swath", o->swath_deg, "full angle, degrees; its far end sets the ping rate", 1.0, 160.0);
  number(app, "--beams", o->beams, "over the swath, equally spaced on the bottom", 1, 100000);
  number(app, "--beam", o->beam_deg, "width along the track, degrees", 0.01, 90.0);
  number(app, "--sound-speed", o->sound_speed_mps, "m/s", 1300.0, 1700.0);
  number(app, "--dead-time", o->dead_s, "between a ping's last echo and the next ping, s", 0.0, 10.0);
  number(app, "--highest-rate", o->highest_hz, "of pings that the head can, Hz", 0.01, 1000.0);
  app->add_flag("--touch", o->touch,
                "count pings whose footprint touches the feature, not only those whose axis hits it");
  o->add_flags(app);
  return {app, [o] { return speed(*o); }};
}

}  // namespace
}  // namespace ensonify::plan

int main(int argc, char** argv) {
  using namespace ensonify;
  CLI::App app(
      "Plans surveys: lines over an area, how fast to run for a feature, a towfish's altitude; imports lines that "
      "survey "
      "software wrote. Missions are written as mission/1, which a scenario's mission.file names.\nExit code: 0 done, 2 "
      "wrong input.",
      "ensonify plan");
  app.require_subcommand(1);
  const std::vector<plan::Verb> verbs = {plan::add_lines(app), plan::add_speed(app), plan::add_sidescan(app),
                                         plan::add_import(app)};
  return tool_main(app, argc, argv, [&]() -> int {
    for (const auto& verb : verbs) {
      if (!verb.app->parsed()) continue;
      try {
        return verb.run();
      } catch (const std::invalid_argument& error) {  // a kernel refuses
        throw UserError(error.what());
      }
    }
    return kExitOk;
  });
}

#include "kernels/survey/lines.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <numbers>
#include <numeric>

#include "components/errors/exit_error.h"
#include "components/terrain/source_of.h"
#include "kernels/survey/spacing.h"
#include "scenarios/world/world.h"
#include "tools/plan/plan_text.h"
#include "tools/plan/verbs.h"

namespace ensonify::plan {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Options {
  std::vector<std::pair<double, double>> corners;
  std::string scenario;
  double depth_m = 0.0, head_depth_m = 0.0, spacing_m = 0.0;
  double heading_deg = 0.0, swath_deg = 120.0, overlap = 0.1, shortest_m = 10.0, row_m = 5.0;
  bool fixed = false, json = false, csv = false, record_in_turns = false;
  survey::RunRules run;
  double megabytes_per_s = 0.0;
};

/// Depths below the head: of the scenario's seabed, or one depth.
survey::DepthAt depth_of(const Options& o) {
  if (o.scenario.empty()) return [depth_m = o.depth_m - o.head_depth_m](const survey::Vec2&) { return depth_m; };
  const World world = read_world(o.scenario);
  const std::shared_ptr<source::TerrainSource> terrain = source::source_of({world.site, world.seabed, "", 1, {}});
  return [terrain, head_m = o.head_depth_m](const survey::Vec2& place) { return -terrain->height_m(place) - head_m; };
}

/// Full width of the swath over a line's middle.
double swath_m(const survey::Runline& line, const survey::DepthAt& depth, double swath_rad) {
  return 2.0 * std::tan(0.5 * swath_rad) * depth(0.5 * (line.start_enu_m + line.end_enu_m));
}

int lines(const Options& o) {
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
  fmt::print("{}", plan_text(set, numbers, run.speed_mps, format_of(o.json, o.csv)));
  return kExitOk;
}

}  // namespace

Verb add_lines(CLI::App& parent) {
  auto o = std::make_shared<Options>();
  CLI::App* app = parent.add_subcommand(
      "lines",
      "Parallel lines over an area, each as far from the one before as the swath allows on the bottom there; with the "
      "time, data and cost that they take.");
  app->add_option("--corner", o->corners, "corner of the area, east and north in world metres; three or more")
      ->required();
  auto* scenario = app->add_option("--scenario", o->scenario, "scenario file whose seabed gives the depths");
  auto* depth = app->add_option("--depth", o->depth_m, "instead: one depth below chart datum, m");
  depth->check(CLI::Range(0.1, 11000.0));
  scenario->excludes(depth);
  app->add_option("--head-depth", o->head_depth_m, "of the transducer below chart datum, m")
      ->check(CLI::Range(0.0, 11000.0))
      ->capture_default_str();
  app->add_option("--heading", o->heading_deg,
                  "of the first line, degrees from grid north; the survey goes on to starboard")
      ->check(CLI::Range(-360.0, 360.0))
      ->capture_default_str();
  app->add_option("--swath", o->swath_deg, "full angle that counts, degrees")
      ->check(CLI::Range(1.0, 160.0))
      ->capture_default_str();
  app->add_option("--overlap", o->overlap, "of a half swath with what is covered")
      ->check(CLI::Range(0.0, 0.9))
      ->capture_default_str();
  app->add_option("--spacing", o->spacing_m, "instead of swath and overlap: distance between lines, m")
      ->check(CLI::Range(0.1, 1e5));
  app->add_flag("--fixed", o->fixed, "one distance between all lines, the one that the shallowest place asks for");
  app->add_option("--shortest", o->shortest_m, "of a line, m")->check(CLI::Range(1.0, 1e5))->capture_default_str();
  app->add_option("--row", o->row_m, "distance along lines at which the bottom is sampled, m")
      ->check(CLI::Range(0.1, 1e4))
      ->capture_default_str();
  app->add_option("--speed", o->run.speed_mps, "on lines, m/s")->check(CLI::Range(0.01, 30.0))->capture_default_str();
  app->add_option("--turn-speed", o->run.turn_speed_mps, "m/s")->check(CLI::Range(0.01, 30.0))->capture_default_str();
  app->add_option("--turning-radius", o->run.turning_radius_m, "m")->check(CLI::Range(0.1, 1e4))->capture_default_str();
  app->add_option("--run-in", o->run.run_in_m, "m")->check(CLI::Range(0.0, 1e4))->capture_default_str();
  app->add_option("--run-out", o->run.run_out_m, "m")->check(CLI::Range(0.0, 1e4))->capture_default_str();
  app->add_option("--data-rate", o->megabytes_per_s, "of what is recorded, 1e6 bytes/s")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  app->add_flag("--record-in-turns", o->record_in_turns, "turns are recorded too");
  app->add_option("--day-rate", o->run.cost_per_day, "cost of a day of 24 h, any currency")
      ->check(CLI::Range(0.0, 1e12))
      ->capture_default_str();
  app->add_flag("--json", o->json, "print JSON");
  app->add_flag("--csv", o->csv, "print CSV");
  return {app, [o, scenario, depth] {
            if (scenario->count() + depth->count() == 0) {
              throw UserError("no depths; allowed: --scenario FILE or --depth M");
            }
            return lines(*o);
          }};
}

}  // namespace ensonify::plan

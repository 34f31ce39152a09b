#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <numbers>

#include "components/errors/exit_error.h"
#include "kernels/survey/spacing.h"
#include "tools/plan/plan_text.h"
#include "tools/plan/verbs.h"

namespace ensonify::plan {
namespace {

struct Options {
  double feature_m = 1.0, depth_m = 0.0, swath_deg = 120.0, beam_deg = 1.0, sound_speed_mps = 1500.0, dead_s = 0.0,
         highest_hz = 50.0;
  int pings = 3, beams = 256;
  bool touch = false, json = false, csv = false;
};

int speed(const Options& o) {
  constexpr double kDegree = std::numbers::pi / 180.0;
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
                                format_of(o.json, o.csv)));
  return kExitOk;
}

}  // namespace

Verb add_speed(CLI::App& parent) {
  auto o = std::make_shared<Options>();
  CLI::App* app = parent.add_subcommand("speed", "Highest speed over ground at which a feature gets its pings.");
  app->add_option("--feature", o->feature_m, "its length along and width across the track, m")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  app->add_option("--pings", o->pings, "pings that must hit it")->check(CLI::Range(1, 1000))->capture_default_str();
  app->add_option("--depth", o->depth_m, "of the bottom below the head, m")
      ->check(CLI::Range(0.1, 11000.0))
      ->required();
  app->add_option("--swath", o->swath_deg, "full angle, degrees; its far end sets the ping rate")
      ->check(CLI::Range(1.0, 160.0))
      ->capture_default_str();
  app->add_option("--beams", o->beams, "over the swath, equally spaced on the bottom")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app->add_option("--beam", o->beam_deg, "width along the track, degrees")
      ->check(CLI::Range(0.01, 90.0))
      ->capture_default_str();
  app->add_option("--sound-speed", o->sound_speed_mps, "m/s")->check(CLI::Range(1300.0, 1700.0))->capture_default_str();
  app->add_option("--dead-time", o->dead_s, "between a ping's last echo and the next ping, s")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  app->add_option("--highest-rate", o->highest_hz, "of pings that the head can, Hz")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  app->add_flag("--touch", o->touch,
                "count pings whose footprint touches the feature, not only those whose axis hits it");
  app->add_flag("--json", o->json, "print JSON");
  app->add_flag("--csv", o->csv, "print CSV");
  return {app, [o] { return speed(*o); }};
}

}  // namespace ensonify::plan

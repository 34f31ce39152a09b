#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <numbers>

#include "components/errors/exit_error.h"
#include "kernels/survey/spacing.h"
#include "tools/plan/plan_text.h"
#include "tools/plan/verbs.h"

namespace ensonify::plan {
namespace {

struct Options {
  double range_m = 0.0, share = 0.1, least_m = 3.0, nadir_deg = 25.0, overlap = 0.1, object_m = 1.0;
  bool json = false, csv = false;
};

int sidescan(const Options& o) {
  constexpr double kDegree = std::numbers::pi / 180.0;
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
                                format_of(o.json, o.csv)));
  return kExitOk;
}

}  // namespace

Verb add_sidescan(CLI::App& parent) {
  auto o = std::make_shared<Options>();
  CLI::App* app = parent.add_subcommand("sidescan", "Altitude of a towfish and the distance of its lines.");
  app->add_option("--range", o->range_m, "slant range to either side, m")->check(CLI::Range(1.0, 5000.0))->required();
  app->add_option("--share", o->share, "altitude over range")->check(CLI::Range(0.01, 0.9))->capture_default_str();
  app->add_option("--least", o->least_m, "altitude that obstacles ask for, m")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  app->add_option("--nadir", o->nadir_deg, "half angle of the gap below, degrees")
      ->check(CLI::Range(0.0, 80.0))
      ->capture_default_str();
  app->add_option("--overlap", o->overlap, "of neighbouring images")
      ->check(CLI::Range(0.0, 0.9))
      ->capture_default_str();
  app->add_option("--object", o->object_m, "height of an object whose shadow is printed, m")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  app->add_flag("--json", o->json, "print JSON");
  app->add_flag("--csv", o->csv, "print CSV");
  return {app, [o] { return sidescan(*o); }};
}

}  // namespace ensonify::plan

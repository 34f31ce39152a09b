// Five lines of 1 km in 0.5 m/s across them, disturbed: how far the vehicle truly is from its line with RTK, and how
// far it estimates to be with poorer receivers.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tests/system/closed_loop.h"

using namespace ensonify;
using namespace ensonify::closed_loop;

namespace {

/// Distances that 95 % of the way on lines is nearer than.
struct Within95 {
  double truth_m;     // of the vehicle from its line
  double estimate_m;  // of where it estimates to be
  double error_m;     // of the estimate across the line
};

double within_95(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  return values[values.size() * 95 / 100];
}

/// Runs the lines.
Within95 run_survey(const std::string& vehicle, const std::string& mission, const std::string& instruments = "") {
  const World world = world_of(
      vehicle, mission + ", lawnmower: {centre_m: [0, 0], heading_deg: 0, length_m: 1000, spacing_m: 80, count: 5}");
  std::vector<double> truth_m, estimate_m, error_m;
  const bool done =
      run_line(world, 6000_s, instruments, [&](const auto& state, const auto& pose, const auto& estimate) {
        if (state.state != "on_line") return;
        const auto& line = world.mission.runlines[static_cast<std::size_t>(state.line)];
        const auto off_m = [&](const std::array<double, 3>& place) {
          return runlines::line_position(line, {place[0], place[1]}).cross_track_m;
        };
        const double estimated_m = off_m(estimate.position_enu_m), true_m = off_m(pose.position_enu_m);
        truth_m.push_back(std::abs(true_m));
        estimate_m.push_back(std::abs(estimated_m));
        error_m.push_back(std::abs(estimated_m - true_m));
      });
  REQUIRE(done);
  REQUIRE(truth_m.size() > 10000);  // 5 km at 4 m/s at most, examined 10 times a second
  return {within_95(truth_m), within_95(estimate_m), within_95(error_m)};
}

}  // namespace

TEST_CASE("a kinematic launch is within 1 m of its lines for 95 % of the way") {
  const Within95 off = run_survey(kLaunch, "speed_mps: 2, run_in_m: 80");
  CAPTURE(off.truth_m);
  CHECK(off.truth_m < 1.0);
}

TEST_CASE("a launch moved by forces is within 2 m") {
  const Within95 off = run_survey(kLaunchByForces, "speed_mps: 4, run_in_m: 120");
  CAPTURE(off.truth_m);
  CHECK(off.truth_m < 2.0);
}

TEST_CASE("an AUV moved by forces is within 2 m") {
  const Within95 off = run_survey(kAuvByForces, "speed_mps: 2, depth_m: 5, run_in_m: 120");
  CAPTURE(off.truth_m);
  CHECK(off.truth_m < 2.0);
}

namespace {

/// A kinematic launch with a tactical inertial unit, a satellite compass and a receiver of a grade.
Within95 run_by_filter(const std::string& gnss) {
  return run_survey(
      kLaunch, "speed_mps: 4, run_in_m: 80",
      "attitude_rate_hz: 50\nimu: { grade: tactical, rate_hz: 50 }\ngnss: { position_m: [0, 0, -4], grade: " + gnss +
          " }\nheading: { grade: satellite }\n");
}

}  // namespace

TEST_CASE("with RTK errors and the filter a kinematic launch is truly within 1 m") {
  const Within95 off = run_by_filter("rtk");
  CAPTURE(off.truth_m, off.error_m);
  CHECK(off.truth_m < 1.0);
  CHECK(off.error_m < 0.1);
}

TEST_CASE("with poorer receivers a launch is within 1 m by its estimate, truly by its error") {
  for (const char* gnss : {"dgps", "single"}) {
    const Within95 off = run_by_filter(gnss);
    CAPTURE(gnss, off.truth_m, off.estimate_m, off.error_m);
    CHECK(off.estimate_m < 1.0);
    CHECK(off.truth_m < 1.0 + off.error_m);
    CHECK(off.error_m > 0.3);  // the receiver is poor: the estimate's own error is no pretext
  }
}

// Five lines of 1 km in 0.5 m/s across them, disturbed: how far the vehicle truly is from its line with RTK, and how
// far it believes to be with poorer receivers.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "components/autopilot/node.h"
#include "components/navigation/node.h"
#include "components/runtime/config/config_reader.h"
#include "components/runtime/testing.h"
#include "components/vehicle/model.h"

using namespace ensonify;

namespace {

constexpr SimTime kPeriod = 100_ms;  // of the autopilot's commands

/// What RTK and a motion sensor make of a pose: white noise of 2 cm, 2 cm/s and 0.05 degrees, each axis.
msg::Estimate estimate_of(const msg::Pose& pose, const random::Stream& noise, std::uint64_t n) {
  msg::Estimate estimate;
  estimate.stamp_ns = pose.stamp_ns;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    estimate.position_enu_m[axis] = pose.position_enu_m[axis] + 0.02 * noise.normal(n, axis);
    estimate.velocity_enu_mps[axis] = pose.velocity_enu_mps[axis] + 0.02 * noise.normal(n, 3 + axis);
  }
  auto attitude = frames::attitude_of(frames::quaternion_of(pose.enu_from_body));
  attitude.heading_rad += 0.05 * 3.14159265 / 180.0 * noise.normal(n, 6);
  estimate.enu_from_body = frames::wxyz_of(frames::enu_from_body(attitude));
  return estimate;
}

Scenario world_of(const std::string& vehicle, const std::string& mission) {
  const std::string text =
      "ensonify: scenario/1\nsite: {latitude_deg: 53, longitude_deg: -9}\nseed: 5\n"
      "seabed: {kind: layers, layers: {ground: {plane: {depth_m: 60}}}}\n"
      "current: {profile: [{depth_m: 0, speed_mps: 0.5, heading_deg: 90}]}\nvehicles: {auv: {" +
      vehicle + "}}\nmission: {" + mission +
      ", lawnmower: {centre_m: [0, 0], heading_deg: 0, length_m: 1000, spacing_m: 80, count: 5}}\n";
  auto from = ConfigReader::from_text(text, std::string(std::getenv("ENSONIFY_SOURCE")) + "/lines.yaml");
  Scenario scenario = read_scenario(from, "lines.yaml");
  from.finish();
  return scenario;
}

/// Distances that 95 % of the way on lines is nearer than.
struct Within95 {
  double truth_m;     // of the vehicle from its line
  double estimate_m;  // of where it believes to be
  double error_m;     // of the estimate across the line
};

double within_95(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  return values[values.size() * 95 / 100];
}

/// Sails the lines. `instruments` of a navigation process whose filter makes the estimate; "": estimate_of().
Within95 sail(const std::string& vehicle, const std::string& mission, const std::string& instruments = "") {
  const Scenario scenario = world_of(vehicle, mission);
  auto empty = ConfigReader::from_text("{}", "auv.yaml");
  const auto vehicle_config = VehicleConfig::read(empty, scenario, "auv");
  const auto pilot_config = AutopilotConfig::read(empty, scenario, "pilot");
  empty.finish();

  VehicleModel model(vehicle_config, *vehicle_config.start, 0_s);
  NodeUnderTest<AutopilotNode> pilot(pilot_config);
  std::optional<NodeUnderTest<NavigationNode>> navigation;
  if (!instruments.empty()) {
    auto from = ConfigReader::from_text(instruments, "nav.yaml");
    const auto navigation_config = NavigationConfig::read(from, scenario, "nav");
    from.finish();
    navigation.emplace(navigation_config);
  }
  const random::Stream noise(5, "rtk");
  std::vector<double> truth_m, estimate_m, error_m;
  std::vector<msg::Guidance> orders;
  for (SimTime now{0}; now < 6000_s && !pilot.finished(); now += kPeriod) {
    if (!orders.empty()) model.command(orders.back());  // 100 ms old
    std::vector<msg::Estimate> estimates;
    msg::Pose pose;
    for (SimTime t = now == SimTime{0} ? now : now - kPeriod + 20_ms; t <= now; t += 20_ms) {
      model.advance(t);
      pose = model.pose();
      if (navigation) navigation->give("pose", pose);
    }
    if (navigation) {
      estimates = navigation->step_until<msg::Estimate>("estimate", now);
    } else {
      estimates.push_back(estimate_of(pose, noise, static_cast<std::uint64_t>(now.count())));
    }
    for (const auto& estimate : estimates) pilot.give("estimate", estimate);
    orders = pilot.step_until<msg::Guidance>("command", now);
    for (const auto& mission_state : pilot.step_until<msg::MissionState>("mission", now)) {
      if (mission_state.state != "on_line") continue;
      const auto& line = scenario.mission.runlines[static_cast<std::size_t>(mission_state.line)];
      const auto off_m = [&](const std::array<double, 3>& place) {
        return navigation::line_position(line, {place[0], place[1]}).cross_track_m;
      };
      const double believed_m = off_m(estimates.back().position_enu_m), true_m = off_m(pose.position_enu_m);
      truth_m.push_back(std::abs(true_m));
      estimate_m.push_back(std::abs(believed_m));
      error_m.push_back(std::abs(believed_m - true_m));
    }
  }
  REQUIRE(pilot.finished());
  REQUIRE(truth_m.size() > 10000);  // 5 km at 4 m/s at most, looked at 10 times a second
  return {within_95(truth_m), within_95(estimate_m), within_95(error_m)};
}

const std::string kLaunch = "turning_radius_m: 15, acceleration_mps2: 0.3, disturbance: {preset: survey_launch}";
const std::string kLaunchByForces =
    "kind: hydrodynamic, dynamics: components/vehicle/hydrodynamic/survey_launch.yaml, turning_radius_m: 30, "
    "disturbance: {preset: survey_launch}, floats: {}";
const std::string kAuvByForces =
    "kind: hydrodynamic, dynamics: components/vehicle/hydrodynamic/remus_100.yaml, turning_radius_m: 25, "
    "disturbance: {preset: auv}";

}  // namespace

TEST_CASE("a kinematic launch is within 1 m of its lines for 95 % of the way") {
  const Within95 off = sail(kLaunch, "speed_mps: 2, run_in_m: 80");
  CAPTURE(off.truth_m);
  CHECK(off.truth_m < 1.0);
}

TEST_CASE("a launch moved by forces is within 2 m") {
  const Within95 off = sail(kLaunchByForces, "speed_mps: 4, run_in_m: 120");
  CAPTURE(off.truth_m);
  CHECK(off.truth_m < 2.0);
}

TEST_CASE("an AUV moved by forces is within 2 m") {
  const Within95 off = sail(kAuvByForces, "speed_mps: 2, depth_m: 5, run_in_m: 120");
  CAPTURE(off.truth_m);
  CHECK(off.truth_m < 2.0);
}

namespace {

/// A kinematic launch with a tactical inertial unit, a satellite compass and a receiver of a grade.
Within95 sail_by_filter(const std::string& gnss) {
  return sail(kLaunch, "speed_mps: 4, run_in_m: 80",
              "attitude_rate_hz: 50\nimu: { grade: tactical, rate_hz: 50 }\ngnss: { position_m: [0, 0, -4], grade: " +
                  gnss + " }\nheading: { grade: satellite }\n");
}

}  // namespace

TEST_CASE("with an RTK receiver's own errors and the filter a kinematic launch is truly within 1 m") {
  const Within95 off = sail_by_filter("rtk");
  CAPTURE(off.truth_m, off.error_m);
  CHECK(off.truth_m < 1.0);
  CHECK(off.error_m < 0.1);
}

TEST_CASE(
    "with poorer receivers a kinematic launch is within 1 m by its estimate, and truly as much farther as that errs") {
  for (const char* gnss : {"dgps", "single"}) {
    const Within95 off = sail_by_filter(gnss);
    CAPTURE(gnss, off.truth_m, off.estimate_m, off.error_m);
    CHECK(off.estimate_m < 1.0);
    CHECK(off.truth_m < 1.0 + off.error_m);
    CHECK(off.error_m > 0.3);  // the receiver is poor: the estimate's own error is no pretext
  }
}

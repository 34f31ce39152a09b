// Five lines of 1 km in 0.5 m/s across them, disturbed, with RTK: how far the vehicle truly is from its line.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "components/autopilot/node.h"
#include "components/runtime/config/config_reader.h"
#include "components/runtime/testing.h"
#include "components/vehicle/model.h"

using namespace ensonify;

namespace {

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

/// Distance that 95 % of the way on lines is nearer to them than.
double off_track_95_m(const std::string& vehicle, double run_in_m) {
  const std::string text =
      "ensonify: scenario/1\nsite: {latitude_deg: 53, longitude_deg: -9}\nseed: 5\n"
      "seabed: {kind: layers, layers: {ground: {plane: {depth_m: 60}}}}\n"
      "current: {profile: [{depth_m: 0, speed_mps: 0.5, heading_deg: 90}]}\nvehicles: {auv: {" +
      vehicle + "}}\nmission: {speed_mps: 2, depth_m: 5, run_in_m: " + std::to_string(run_in_m) +
      ", lawnmower: {centre_m: [0, 0], heading_deg: 0, length_m: 1000, spacing_m: 80, count: 5}}\n";
  auto from = ConfigReader::from_text(text, std::string(std::getenv("ENSONIFY_SOURCE")) + "/lines.yaml");
  const Scenario scenario = read_scenario(from, "lines.yaml");
  from.finish();
  auto empty = ConfigReader::from_text("{}", "auv.yaml");
  const auto vehicle_config = VehicleConfig::read(empty, scenario, "auv");
  const auto pilot_config = AutopilotConfig::read(empty, scenario, "pilot");
  empty.finish();

  VehicleModel model(vehicle_config, *vehicle_config.start, 0_s);
  NodeUnderTest<AutopilotNode> pilot(pilot_config);
  const random::Stream noise(5, "rtk");
  std::vector<double> off_m;
  std::vector<msg::Guidance> orders;
  for (SimTime now{0}; now < 6000_s && !pilot.finished(); now += 100_ms) {
    model.advance(now);
    if (!orders.empty()) model.command(orders.back());  // 100 ms old
    const msg::Pose pose = model.pose();
    pilot.give("estimate", estimate_of(pose, noise, static_cast<std::uint64_t>(now.count())));
    orders = pilot.step_until<msg::Guidance>("command", now);
    for (const auto& mission : pilot.step_until<msg::MissionState>("mission", now)) {
      if (mission.state != "on_line") continue;
      const auto& line = scenario.mission.runlines[static_cast<std::size_t>(mission.line)];
      const navigation::Vec2 place(pose.position_enu_m[0], pose.position_enu_m[1]);
      off_m.push_back(std::abs(navigation::line_position(line, place).cross_track_m));
    }
  }
  REQUIRE(pilot.finished());
  REQUIRE(off_m.size() > 20000);  // 5 km at 2 m/s, looked at 10 times a second
  std::sort(off_m.begin(), off_m.end());
  return off_m[off_m.size() * 95 / 100];
}

}  // namespace

TEST_CASE("a kinematic launch is within 1 m of its lines for 95 % of the way") {
  const double off_m =
      off_track_95_m("turning_radius_m: 15, acceleration_mps2: 0.3, disturbance: {preset: survey_launch}", 80);
  CAPTURE(off_m);
  CHECK(off_m < 1.0);
}

TEST_CASE("an AUV moved by forces is within 2 m") {
  const double off_m = off_track_95_m(
      "kind: hydrodynamic, dynamics: components/vehicle/hydrodynamic/remus_100.yaml, turning_radius_m: 25, "
      "disturbance: {preset: auv}",
      120);
  CAPTURE(off_m);
  CHECK(off_m < 2.0);
}

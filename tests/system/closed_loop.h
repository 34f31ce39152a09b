#pragma once

#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "components/autopilot/node.h"
#include "components/config/config_reader.h"
#include "components/navigation/node.h"
#include "components/runtime/testing/node_under_test.h"
#include "components/vehicle/model.h"

namespace ensonify::closed_loop {

inline const std::string kLaunch = "turning_radius_m: 15, acceleration_mps2: 0.3, disturbance: {preset: survey_launch}";
inline const std::string kLaunchByForces =
    "kind: hydrodynamic, dynamics: components/vehicle/hydrodynamic/survey_launch.yaml, turning_radius_m: 30, "
    "disturbance: {preset: survey_launch}, floats: {}";
inline const std::string kAuvByForces =
    "kind: hydrodynamic, dynamics: components/vehicle/hydrodynamic/remus_100.yaml, turning_radius_m: 25, "
    "disturbance: {preset: auv}";

/// Ground 60 m deep, a current to the east, and one vehicle with a mission.
inline World world_of(const std::string& vehicle, const std::string& mission, double current_mps = 0.5) {
  const std::string text =
      "ensonify: scenario/1\nsite: {latitude_deg: 53, longitude_deg: -9}\nseed: 5\n"
      "seabed: {kind: layers, layers: {ground: {plane: {depth_m: 60}}}}\n"
      "current: {profile: [{depth_m: 0, speed_mps: " +
      std::to_string(current_mps) + ", heading_deg: 90}]}\nvehicles: {auv: {" + vehicle + "}}\nmission: {" + mission +
      "}\n";
  auto from = ConfigReader::from_text(text, std::string(std::getenv("ENSONIFY_SOURCE")) + "/world.yaml");
  World world = read_world(from, "world.yaml");
  from.finish();
  return world;
}

/// What RTK and a motion sensor make of a pose: white noise of 2 cm, 2 cm/s and 0.05 degrees, each axis.
inline msg::Estimate estimate_of(const msg::Pose& pose, const random::Stream& noise, std::uint64_t n) {
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

/// Autopilot and vehicle, commands ten times a second and 100 ms old, until the mission is done or `end`. `instruments`
/// of a navigation process whose filter makes the estimate; "": estimate_of(). `see(mission state, true pose,
/// estimate)` at each command. Returns whether the mission was done.
template <class See>
bool run_line(const World& world, SimTime end, const std::string& instruments, See&& see) {
  constexpr SimTime kPeriod = 100_ms;
  auto empty = ConfigReader::from_text("{}", "auv.yaml");
  const auto vehicle_config = VehicleConfig::read(empty, world, "auv");
  const auto pilot_config = AutopilotConfig::read(empty, world, "pilot");
  empty.finish();

  VehicleModel model(vehicle_config, *vehicle_config.start, 0_s);
  NodeUnderTest<AutopilotNode> pilot(pilot_config);
  std::optional<NodeUnderTest<NavigationNode>> navigation;
  if (!instruments.empty()) {
    auto from = ConfigReader::from_text(instruments, "nav.yaml");
    const auto navigation_config = NavigationConfig::read(from, world, "nav");
    from.finish();
    navigation.emplace(navigation_config);
  }
  const random::Stream noise(5, "rtk");
  std::vector<msg::Guidance> orders;
  for (SimTime now{0}; now < end && !pilot.finished(); now += kPeriod) {
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
    for (const auto& state : pilot.step_until<msg::MissionState>("mission", now)) see(state, pose, estimates.back());
  }
  return pilot.finished();
}

}  // namespace ensonify::closed_loop

#pragma once

#include <cstdlib>
#include <numbers>
#include <string>

#include "components/autopilot/node.h"
#include "components/config/config_reader.h"
#include "components/navigation/node.h"
#include "components/runtime/testing/nodes_under_test.h"
#include "components/vehicle/node.h"

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

/// Navigation by RTK and a motion sensor: the true pose with white noise of 2 cm, 2 cm/s and 0.05 degrees, each axis.
class RtkNode {
 public:
  struct Config {};

  RtkNode(const Config&, Ports& ports) : estimates_(ports.out<msg::Estimate>("estimate", {.rate = Rate{10, 1}})) {
    ports.in<msg::Pose>("pose", [this](const msg::Pose& pose) { pose_ = pose; });
  }

  SimTime step(SimTime now) {
    const auto n = static_cast<std::uint64_t>(now.count());
    msg::Estimate estimate;
    estimate.stamp_ns = pose_.stamp_ns;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      estimate.position_enu_m[axis] = pose_.position_enu_m[axis] + 0.02 * noise_.normal(n, axis);
      estimate.velocity_enu_mps[axis] = pose_.velocity_enu_mps[axis] + 0.02 * noise_.normal(n, 3 + axis);
    }
    auto attitude = frames::attitude_of(frames::quaternion_of(pose_.enu_from_body));
    attitude.heading_rad += 0.05 * std::numbers::pi / 180.0 * noise_.normal(n, 6);
    estimate.enu_from_body = frames::wxyz_of(frames::enu_from_body(attitude));
    estimates_.send(estimate);
    return now + 100_ms;
  }

 private:
  random::Stream noise_{5, "rtk"};
  msg::Pose pose_;
  Ports::Out<msg::Estimate> estimates_;
};

/// Autopilot and vehicle, commands ten times a second, until the mission is done or `end`. `instruments` of a
/// navigation process whose filter makes the estimate; "": RtkNode. `see(mission state, true pose, estimate)` at each
/// command. Returns whether the mission was done.
template <class See>
bool run_line(const World& world, SimTime end, const std::string& instruments, See&& see) {
  auto empty = ConfigReader::from_text("{}", "auv.yaml");
  auto vehicle = VehicleConfig::read(empty, world, "auv");
  const auto pilot = AutopilotConfig::read(empty, world, "pilot");
  empty.finish();
  vehicle.pose_rate_hz = instruments.empty() ? 10 : 50;

  NodesUnderTest nodes;
  nodes.add<VehicleNode>("auv", vehicle);
  if (instruments.empty()) {
    nodes.add<RtkNode>("nav", {});
  } else {
    auto from = ConfigReader::from_text(instruments, "nav.yaml");
    nodes.add<NavigationNode>("nav", NavigationConfig::read(from, world, "nav"));
    from.finish();
  }
  nodes.add<AutopilotNode>("pilot", pilot);
  msg::Pose truth;
  msg::Estimate estimate;
  nodes.watch<msg::Pose>("auv/pose", [&](const msg::Pose& pose) { truth = pose; });
  nodes.watch<msg::Estimate>("nav/estimate", [&](const msg::Estimate& estimated) { estimate = estimated; });
  nodes.watch<msg::MissionState>("pilot/mission", [&](const msg::MissionState& state) { see(state, truth, estimate); });
  return nodes.run_until(end);
}

}  // namespace ensonify::closed_loop

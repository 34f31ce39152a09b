#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "components/autopilot/node.h"
#include "components/runtime/testing/node_under_test.h"
#include "components/runtime/testing/nodes_under_test.h"
#include "kernels/vehicle/motion/kinematics.h"

/// Shared by tests of the autopilot: three lines, and a boat that it steers.
namespace ensonify::piloted {

using runlines::Vec2;

inline AutopilotConfig three_lines(double spacing_m) {
  AutopilotConfig config;
  config.plan.scenario_file = "bay.yaml";
  config.plan.limits = {.acceleration_mps2 = 0.5, .deceleration_mps2 = 0.5, .turning_radius_m = 10};
  config.plan.mission.speed_mps = 2.0;
  config.plan.mission.run_in_m = 15.0;
  config.plan.mission.runlines = runlines::lawnmower({0, 0}, 0.3, 150, spacing_m, 3);
  config.plan.mission.steps = steps_of(config.plan.mission.runlines);
  return config;
}

/// A boat and its navigation: kinematics on one side, a perfect estimate ten times a second on the other.
class BoatNode {
 public:
  struct Config {
    motion::Limits limits;
    motion::State start;
    Vec2 current_enu_mps{0, 0};
    std::function<double(double north_m)> bottom = nullptr;  // depth, NaN: not received; given: an altimeter is carried
    std::optional<SimTime> uncertain_after = std::nullopt;   // the place to the north is known within 0.5 m, then 3 m
  };

  BoatNode(const Config& config, Ports& ports)
      : config_(config),
        command_{config.start.heading_rad, config.start.speed_mps, config.start.position_enu_m.z()},
        estimates_(ports.out<msg::Estimate>("estimate", {.rate = Rate{10, 1}})) {
    if (config.bottom) altitudes_ = ports.out<msg::Altitude>("altitude", {.rate = Rate{10, 1}});
    const auto take = [this](const msg::Guidance& order) {
      command_.heading_rad = order.heading_grid_rad, command_.speed_mps = order.speed_mps;
      if (!std::isnan(order.depth_m)) command_.height_m = -order.depth_m;
    };
    ports.in<msg::Guidance>("command", take, {.delay = 100_ms});
    track_.push_back(config.start);
  }

  SimTime step(SimTime now) {
    motion::State state = track_.back();
    msg::Estimate estimate;
    estimate.stamp_ns = now.count();
    estimate.position_enu_m = {state.position_enu_m.x(), state.position_enu_m.y(), state.position_enu_m.z()};
    estimate.enu_from_body = frames::wxyz_of(frames::enu_from_body(frames::Attitude{state.heading_rad, 0, 0}));
    estimate.velocity_enu_mps = {state.speed_mps * std::sin(state.heading_rad) + config_.current_enu_mps.x(),
                                 state.speed_mps * std::cos(state.heading_rad) + config_.current_enu_mps.y(), 0.0};
    if (config_.uncertain_after) {
      const double sd_m = now < *config_.uncertain_after ? 0.5 : 3.0;
      estimate.position_covariance_enu_m2 = {0.1, 0, 0, 0, sd_m * sd_m, 0, 0, 0, 0.1};
    }
    estimates_.send(estimate);
    if (altitudes_) {
      const double range_m = config_.bottom(state.position_enu_m.y()) + state.position_enu_m.z();
      const bool valid = !std::isnan(range_m);
      altitudes_->send(msg::Altitude{now.count(), valid, valid ? range_m : 0.0});
    }
    state = motion::advance(state, command_, 0.1, config_.limits);
    state.position_enu_m.head<2>() += 0.1 * config_.current_enu_mps;
    track_.push_back(state);
    return now + 100_ms;
  }

  /// Its true state at a time that it has passed.
  const motion::State& at(SimTime t) const { return track_.at(static_cast<std::size_t>(t / 100_ms)); }

 private:
  Config config_;
  motion::Command command_;
  std::vector<motion::State> track_;  // ten times a second
  Ports::Out<msg::Estimate> estimates_;
  std::optional<Ports::Out<msg::Altitude>> altitudes_;
};

/// An autopilot and its boat on one bus.
class Loop {
 public:
  Loop(const AutopilotConfig& config, const motion::State& start, const Vec2& current_enu_mps = {0, 0})
      : boat{config.plan.limits, start, current_enu_mps}, config_(config) {}

  /// Runs until the mission is done or `t`; `see(mission state, boat's true state)` at each command. Once.
  template <class See>
  void run_until(SimTime t, See&& see) {
    const BoatNode& moving = nodes.add<BoatNode>("boat", boat);
    nodes.add<AutopilotNode>("pilot", config_);
    nodes.watch<msg::MissionState>("pilot/mission",
                                   [&](const msg::MissionState& mission) { see(mission, moving.at(nodes.now())); });
    finished_ = nodes.run_until(t);
  }

  NodesUnderTest nodes;
  BoatNode::Config boat;
  bool finished() const { return finished_; }
  SimTime now() const { return nodes.now(); }

 private:
  AutopilotConfig config_;
  bool finished_ = false;
};

inline AutopilotConfig steps(std::vector<MissionStep> steps) {
  AutopilotConfig config = three_lines(40.0);
  config.plan.mission.steps = std::move(steps);
  config.plan.mission.runlines.clear();
  return config;
}

inline const motion::State kUnderWay{{0, 0, 0}, 0.0, 2.0, 0.0};

/// The states that a mission goes through, each once in a row.
inline std::vector<std::string> states_of(Loop& loop, SimTime until) {
  std::vector<std::string> states;
  loop.run_until(until, [&](const msg::MissionState& mission, const motion::State&) {
    if (states.empty() || states.back() != mission.state) states.push_back(mission.state);
  });
  return states;
}

}  // namespace ensonify::piloted

#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "components/autopilot/node.h"
#include "components/runtime/testing/node_under_test.h"
#include "kernels/vehicle/motion/kinematics.h"

/// What tests of the autopilot share: three lines, and a loop with a vehicle.
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

/// The vehicle and navigation of a test: kinematics on one side, a perfect estimate on the other, 0.1 s of delay.
class Loop {
 public:
  Loop(const AutopilotConfig& config, const motion::State& start, const Vec2& current_enu_mps = {0, 0})
      : autopilot(config), limits_(config.plan.limits), state_(start), current_enu_mps_(current_enu_mps) {
    command_ = {start.heading_rad, start.speed_mps, start.position_enu_m.z()};
  }

  /// Runs until the mission is done or `t`; `see(mission state, vehicle state)` at each command.
  template <class See>
  void run_until(SimTime t, See&& see) {
    motion::Command next = command_;
    for (SimTime now = now_; now <= t && !autopilot.finished(); now += 100_ms) {
      msg::Estimate estimate;
      estimate.stamp_ns = now.count();
      estimate.position_enu_m = {state_.position_enu_m.x(), state_.position_enu_m.y(), state_.position_enu_m.z()};
      estimate.enu_from_body = frames::wxyz_of(frames::enu_from_body(frames::Attitude{state_.heading_rad, 0, 0}));
      estimate.velocity_enu_mps = {state_.speed_mps * std::sin(state_.heading_rad) + current_enu_mps_.x(),
                                   state_.speed_mps * std::cos(state_.heading_rad) + current_enu_mps_.y(), 0.0};
      if (uncertain_after) {
        const double sd_m = now < *uncertain_after ? 0.5 : 3.0;
        estimate.position_covariance_enu_m2 = {0.1, 0, 0, 0, sd_m * sd_m, 0, 0, 0, 0.1};
      }
      autopilot.give("estimate", estimate);
      if (bottom) {
        const double range_m = bottom(state_.position_enu_m.y()) + state_.position_enu_m.z();
        autopilot.give("altitude", msg::Altitude{now.count(), !std::isnan(range_m), range_m});
      }
      const auto orders = autopilot.step_until<msg::Guidance>("command", now);
      for (const auto& mission : autopilot.step_until<msg::MissionState>("mission", now)) see(mission, state_);
      command_ = next;
      if (!orders.empty()) next = {orders[0].heading_grid_rad, orders[0].speed_mps, next.height_m};
      if (!orders.empty() && !std::isnan(orders[0].depth_m)) next.height_m = -orders[0].depth_m;
      state_ = motion::advance(state_, command_, 0.1, limits_);
      state_.position_enu_m.head<2>() += 0.1 * current_enu_mps_;
      now_ = now + 100_ms;
    }
  }

  NodeUnderTest<AutopilotNode> autopilot;
  std::function<double(double north_m)> bottom;  // depth, NaN: not received; given: an altimeter is carried
  std::optional<SimTime> uncertain_after;        // the place to the north is known within 0.5 m, and then within 3 m
  SimTime now() const { return now_; }

 private:
  motion::Limits limits_;
  motion::State state_;
  motion::Command command_;
  Vec2 current_enu_mps_;
  SimTime now_{0};
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

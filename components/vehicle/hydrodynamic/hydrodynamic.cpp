#include "components/vehicle/hydrodynamic/hydrodynamic.h"

#include <utility>

namespace ensonify {
namespace {

constexpr SimTime kStep = 10_ms;

}  // namespace

HydrodynamicDynamics::HydrodynamicDynamics(const VehicleConfig& config, const motion::State& start, SimTime now)
    : body_(config.hydrodynamics->body),
      helm_(config.hydrodynamics->helm),
      water_(config.water),
      order_{{start.heading_rad, start.speed_mps, start.position_enu_m.z()}, std::nullopt},
      next_(order_),
      next_from_(now),
      grid_(now),
      now_(now) {
  state_ = body_.at_rest({start.position_enu_m, frames::enu_from_body({start.heading_rad, 0.0, 0.0})});
  state_.pose.position_enu_m.z() += water_.tide.at(seconds(now)).height_m;
  const motion::Surroundings water = around(state_, now);
  state_.velocity.head<3>() =
      state_.pose.enu_from_body.conjugate() * water.current_enu_mps + start.speed_mps * frames::Vec3::UnitX();
  // Propellers turn and fins stand as the helm wants them for going on.
  state_.actuators = motion::orders(helm_, body_, state_, order_.command, water);
}

motion::Surroundings HydrodynamicDynamics::around(const motion::BodyState& state, SimTime t) const {
  const double t_s = seconds(t);
  motion::Surroundings water;
  water.water_level_m = water_.tide.at(t_s).height_m;
  const frames::Vec2 current = water_.current.velocity_enu_mps(-state.pose.position_enu_m.z(), t_s);
  water.current_enu_mps = {current.x(), current.y(), 0.0};
  if (water_.floats) {
    water.water_level_m -= vertical::sinkage_m(*water_.floats, body_.through_water(state, water)(0), t_s);
  }
  return water;
}

motion::BodyState HydrodynamicDynamics::stepped(SimTime dt) const {
  const motion::Surroundings water = around(state_, grid_);
  const Order& order = grid_ >= next_from_ ? next_ : order_;
  motion::Command command = order.command;
  command.height_m += water_.tide.at(seconds(grid_)).height_m;
  const Eigen::VectorXd orders =
      order.actuators ? *order.actuators : motion::orders(helm_, body_, state_, command, water);
  // Through the step, and any part of it, the water is as in the middle of it: as at its start, it would lag behind
  // what moving() gives, and on a tide of 1.5 m the hull would be metres from the integral of its accelerations after
  // ten minutes.
  const motion::BodyState middle = body_.step(state_, orders, water, seconds(kStep) / 2);
  return body_.step(state_, orders, around(middle, grid_ + kStep / 2), seconds(dt));
}

void HydrodynamicDynamics::advance(SimTime now) {
  for (; grid_ + kStep <= now; grid_ += kStep) {
    state_ = stepped(kStep);
    if (grid_ >= next_from_) order_ = next_;
  }
  now_ = now;
}

/// Above the water level.
double HydrodynamicDynamics::height_m() const {
  return state_.pose.position_enu_m.z() - water_.tide.at(seconds(grid_)).height_m;
}

void HydrodynamicDynamics::command(double heading_rad, double speed_mps, std::optional<double> depth_m) {
  if (grid_ >= next_from_) order_ = next_;
  if (next_.actuators) next_.command.height_m = height_m();  // where they have brought it
  next_.actuators.reset();
  next_.command.heading_rad = heading_rad;
  next_.command.speed_mps = speed_mps;
  if (depth_m) next_.command.height_m = -*depth_m;
  next_from_ = now_;
}

void HydrodynamicDynamics::actuate(Eigen::VectorXd orders) {
  if (grid_ >= next_from_) order_ = next_;
  next_.actuators = std::move(orders);
  next_from_ = now_;
}

void HydrodynamicDynamics::stop() { command(frames::attitude_of(state_.pose.enu_from_body).heading_rad, 0.0, {}); }

frames::MovingPose HydrodynamicDynamics::moving() const {
  const motion::BodyState state = now_ == grid_ ? state_ : stepped(now_ - grid_);
  return body_.moving(state, around(state, now_));
}

}  // namespace ensonify

#include "kernels/motion/kinematics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ensonify::motion {
namespace {

frames::Vec3 forward(double heading_rad) { return {std::sin(heading_rad), std::cos(heading_rad), 0.0}; }

double turn_to_go_rad(const State& state, const Command& command) {
  return frames::wrap_pi(command.heading_rad - state.heading_rad);  // positive to starboard
}

double phase_at(const Sinusoid& wave, double t_s) {
  return 2.0 * std::numbers::pi * t_s / wave.period_s + wave.phase_rad;
}

}  // namespace

Ramp speed_ramp(double speed_mps, double target_mps, double dt_s, const Limits& limits) {
  const double rate = target_mps >= speed_mps ? limits.acceleration_mps2 : -limits.deceleration_mps2;
  const double ramp_s = std::min(dt_s, (target_mps - speed_mps) / rate);
  const double reached_mps = ramp_s < dt_s ? target_mps : speed_mps + rate * ramp_s;
  return {reached_mps, (speed_mps + 0.5 * rate * ramp_s) * ramp_s + reached_mps * (dt_s - ramp_s)};
}

double stopping_distance_m(double speed_mps, const Limits& limits) {
  return speed_mps * speed_mps / (2.0 * limits.deceleration_mps2);
}

State advance(const State& state, const Command& command, double dt_s, const Limits& limits) {
  const Ramp ramp = speed_ramp(state.speed_mps, command.speed_mps, dt_s, limits);
  const double radius_m = limits.turning_radius_m;
  const double to_go_rad = turn_to_go_rad(state, command);
  const double side = to_go_rad >= 0.0 ? 1.0 : -1.0;
  const double arc_m = std::min(ramp.distance_m, std::abs(to_go_rad) * radius_m);
  const bool turned = arc_m < ramp.distance_m || to_go_rad == 0.0;

  State next = state;
  next.speed_mps = ramp.speed_mps;
  next.heading_rad = frames::wrap_two_pi(turned ? command.heading_rad : state.heading_rad + side * arc_m / radius_m);

  // The chord of the arc points half way between the headings at its ends.
  const double half_turn_rad = 0.5 * arc_m / radius_m;
  const double chord_m = 2.0 * radius_m * std::sin(half_turn_rad);
  next.position_enu_m += chord_m * forward(state.heading_rad + side * half_turn_rad) +
                         (ramp.distance_m - arc_m) * forward(next.heading_rad);

  const double climb_m = command.height_m - state.position_enu_m.z();
  const double reach_m = limits.vertical_speed_mps * dt_s;
  next.position_enu_m.z() =
      std::abs(climb_m) <= reach_m ? command.height_m : state.position_enu_m.z() + std::copysign(reach_m, climb_m);
  return next;
}

double Sinusoid::value(double t_s) const { return amplitude * std::sin(phase_at(*this, t_s)); }

double Sinusoid::rate(double t_s) const {
  return amplitude * (2.0 * std::numbers::pi / period_s) * std::cos(phase_at(*this, t_s));
}

frames::MovingPose moving_pose(const State& state, const Command& command, const Waves& waves, double t_s,
                               const Limits& limits) {
  const double to_go_rad = turn_to_go_rad(state, command);
  const double side = to_go_rad == 0.0 ? 0.0 : std::copysign(1.0, to_go_rad);
  const double climb_m = command.height_m - state.position_enu_m.z();
  const double climb = climb_m == 0.0 ? 0.0 : std::copysign(limits.vertical_speed_mps, climb_m);

  const frames::Attitude attitude{state.heading_rad, 0.0, waves.roll_rad.value(t_s)};
  const frames::Attitude rates{side * state.speed_mps / limits.turning_radius_m, 0.0, waves.roll_rad.rate(t_s)};
  frames::MovingPose moving;
  moving.pose.position_enu_m = state.position_enu_m + waves.heave_m.value(t_s) * frames::Vec3::UnitZ();
  moving.pose.enu_from_body = frames::enu_from_body(attitude);
  moving.velocity_enu_mps =
      state.speed_mps * forward(state.heading_rad) + (climb + waves.heave_m.rate(t_s)) * frames::Vec3::UnitZ();
  moving.angular_rate_body_radps = frames::body_rates_radps(attitude, rates);
  return moving;
}

}  // namespace ensonify::motion

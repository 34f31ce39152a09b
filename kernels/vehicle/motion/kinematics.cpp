#include "kernels/vehicle/motion/kinematics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace ensonify::motion {
namespace {

constexpr double kThere = 1e-9;  // closer than this to a path is on it

/// Uniform acceleration for a time.
struct Phase {
  double acceleration;
  double duration_s;
};

/// At once at full speed, and at once at rest.
Moving without_inertia(const Moving& from, double target, double dt_s, double fastest) {
  const double way = target - from.value, reach = fastest * dt_s;
  return {std::abs(way) <= reach ? target : from.value + std::copysign(reach, way), 0.0, 0.0};
}

std::array<Phase, 3> plan(const Moving& from, double target, double fastest, double a) {
  const double way = target - from.value, w = from.rate;
  const double spare = way - w * std::abs(w) / (2.0 * a);  // to the target from where braking now would end
  if (std::abs(spare) <= kThere) return {{{w > 0.0 ? -a : a, std::abs(w) / a}, {0.0, 0.0}, {0.0, 0.0}}};

  // With `side` pointing to the target from the stopping point, all of this is a way upwards.
  const double side = std::copysign(1.0, spare), v = side * w, d = side * way;
  const double peak = std::min(fastest, std::sqrt(std::max(0.0, a * d + 0.5 * v * v)));
  const double first = peak >= v ? a : -a;
  const double gained = (peak * peak - v * v) / (2.0 * first), braked = peak * peak / (2.0 * a);
  const double cruise_s = peak > 0.0 ? std::max(0.0, (d - gained - braked) / peak) : 0.0;
  return {{{side * first, (peak - v) / first}, {0.0, cruise_s}, {-side * a, peak / a}}};
}

using frames::Vec3;

Vec3 forward(double heading_rad) { return {std::sin(heading_rad), std::cos(heading_rad), 0.0}; }
Vec3 starboard(double heading_rad) { return {std::cos(heading_rad), -std::sin(heading_rad), 0.0}; }

double turn_to_go_rad(const State& state, const Command& command) {
  return frames::wrap_pi(command.heading_rad - state.heading_rad);  // positive to starboard
}

double speed_rate_mps2(double speed_mps, double target_mps, const Limits& limits) {
  return target_mps >= speed_mps ? limits.acceleration_mps2 : -limits.deceleration_mps2;
}

/// The speed from which on the turn rate limits a turn, not the radius.
double limiting_speed_mps(const Limits& limits) { return limits.turn_rate_radps * limits.turning_radius_m; }

/// When within dt the speed reaches a speed that it has not now, or nothing.
std::optional<double> time_of_speed(double speed_mps, double target_mps, double passed_mps, double dt_s,
                                    const Limits& limits) {
  const bool between = (passed_mps - speed_mps) * (passed_mps - target_mps) < 0.0 || passed_mps == target_mps;
  if (!between || passed_mps == speed_mps) return std::nullopt;
  const double t_s = (passed_mps - speed_mps) / speed_rate_mps2(speed_mps, target_mps, limits);
  return t_s < dt_s ? std::optional(t_s) : std::nullopt;
}

/// A turn that the radius limits: an arc and a straight line, whatever the speed does.
State turn_on_circle(const State& state, const Command& command, double dt_s, const Limits& limits) {
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
  return next;
}

/// A turn at the highest rate while the speed changes uniformly, and a straight line after it.
State turn_at_rate(const State& state, const Command& command, double dt_s, const Limits& limits) {
  const double to_go_rad = turn_to_go_rad(state, command);
  const double rate = std::copysign(limits.turn_rate_radps, to_go_rad == 0.0 ? 1.0 : to_go_rad);
  const double turn_s = std::min(dt_s, to_go_rad / rate);
  const double a =
      state.speed_mps == command.speed_mps ? 0.0 : speed_rate_mps2(state.speed_mps, command.speed_mps, limits);
  const double turned_mps = state.speed_mps + a * turn_s;
  const double heading_rad =
      turn_s < dt_s || to_go_rad == 0.0 ? command.heading_rad : state.heading_rad + rate * turn_s;

  // The integral of (v + a t) forward(heading + rate t), by parts; forward' = starboard, starboard' = -forward.
  State next = state;
  next.position_enu_m += (state.speed_mps * starboard(state.heading_rad) - turned_mps * starboard(heading_rad)) / rate +
                         a / (rate * rate) * (forward(heading_rad) - forward(state.heading_rad));
  const double straight_s = dt_s - turn_s;
  next.position_enu_m += (turned_mps + 0.5 * a * straight_s) * straight_s * forward(heading_rad);
  next.heading_rad = frames::wrap_two_pi(heading_rad);
  next.speed_mps = state.speed_mps + a * dt_s;
  return next;
}

/// East and north, heading and speed. Split where the speed reaches the limiting speed, and for the faster turn also
/// where it intersects the commanded one, so that each part is of one kind.
State advance_level(const State& state, const Command& command, double dt_s, const Limits& limits) {
  const auto split = [&](double t_s, double speed_mps) {
    State part = advance_level(state, command, t_s, limits);
    part.speed_mps = speed_mps;
    return advance_level(part, command, dt_s - t_s, limits);
  };
  const double limiting_mps = limiting_speed_mps(limits), v = state.speed_mps, target = command.speed_mps;
  if (const auto t_s = time_of_speed(v, target, limiting_mps, dt_s, limits)) return split(*t_s, limiting_mps);
  if (std::max(v, speed_ramp(v, target, dt_s, limits).speed_mps) <= limiting_mps) {
    return turn_on_circle(state, command, dt_s, limits);
  }
  if (const auto t_s = time_of_speed(v, target, target, dt_s, limits)) return split(*t_s, target);
  return turn_at_rate(state, command, dt_s, limits);
}

/// The way that a turn with inertia takes, from 0 at the heading of now. At most as fast as the mean speed allows, so
/// that who turns on the circle turns by distance over radius whatever the speed does.
Moving turning(const State& state, const Command& command, double dt_s, double mean_mps, const Limits& limits) {
  const double fastest_radps = turn_rate_radps(mean_mps, limits);
  if (fastest_radps == 0.0) return {};
  return approach({0.0, state.turn_radps}, turn_to_go_rad(state, command), dt_s, fastest_radps,
                  limits.turn_acceleration_radps2);
}

/// Heading and speed of a turn with inertia after a short time; the place stays.
State turned(const State& state, const Command& command, double dt_s, const Limits& limits) {
  const Ramp ramp = speed_ramp(state.speed_mps, command.speed_mps, dt_s, limits);
  const double mean_mps = ramp.distance_m / dt_s, fastest_radps = turn_rate_radps(ramp.speed_mps, limits);
  const Moving turn = turning(state, command, dt_s, mean_mps, limits);
  const bool on_circle = std::abs(turn.rate) >= std::min(fastest_radps, turn_rate_radps(mean_mps, limits));
  State next = state;
  next.speed_mps = ramp.speed_mps;
  next.heading_rad = frames::wrap_two_pi(state.heading_rad + turn.value);
  next.turn_radps = on_circle ? std::copysign(fastest_radps, turn.rate) : turn.rate;
  return next;
}

/// East and north, heading and speed of a turn with inertia: Simpson's rule over pieces of at most 10 ms.
State advance_with_inertia(const State& state, const Command& command, double dt_s, const Limits& limits) {
  constexpr double kPiece_s = 0.01;
  const double pieces = std::ceil(dt_s / kPiece_s - 1e-9), piece_s = dt_s / pieces;
  State now = state;
  for (double piece = 0.0; piece < pieces; ++piece) {
    const State middle = turned(now, command, 0.5 * piece_s, limits);
    State end = turned(now, command, piece_s, limits);
    const auto weighed = [](double weight, const State& at) -> Vec3 {
      return weight * at.speed_mps * forward(at.heading_rad);
    };
    const double sum_mps = now.speed_mps + 4.0 * middle.speed_mps + end.speed_mps;
    const double distance_m = speed_ramp(now.speed_mps, command.speed_mps, piece_s, limits).distance_m;
    if (sum_mps > 0.0) {
      const Vec3 way_mps = weighed(1.0, now) + weighed(4.0, middle) + weighed(1.0, end);
      end.position_enu_m += distance_m / sum_mps * way_mps;
    }
    now = end;
  }
  return now;
}

/// Rate of turn, and how it changes: by inertia, or with the speed where the radius limits it.
Moving turn_now(const State& state, const Command& command, double speed_mps2, const Limits& limits) {
  Moving turn;
  if (std::isinf(limits.turn_acceleration_radps2)) {
    const double to_go_rad = turn_to_go_rad(state, command);
    if (to_go_rad != 0.0) turn.rate = std::copysign(turn_rate_radps(state.speed_mps, limits), to_go_rad);
  } else {
    turn = turning(state, command, 0.0, state.speed_mps, limits);
    turn.rate = state.turn_radps;
  }
  const bool by_radius = state.speed_mps < limiting_speed_mps(limits);
  if (turn.acceleration == 0.0 && turn.rate != 0.0 && by_radius) {
    turn.acceleration = std::copysign(1.0, turn.rate) * speed_mps2 / limits.turning_radius_m;
  }
  return turn;
}

}  // namespace

Moving approach(const Moving& from, double target, double dt_s, double fastest, double acceleration) {
  if (std::isinf(acceleration)) return without_inertia(from, target, dt_s, fastest);
  Moving now{from.value, from.rate, 0.0};
  double left_s = dt_s;
  for (const Phase& phase : plan(from, target, fastest, acceleration)) {
    const double t = std::min(left_s, phase.duration_s);
    now.value += (now.rate + 0.5 * phase.acceleration * t) * t;
    now.rate += phase.acceleration * t;
    now.acceleration = phase.acceleration;
    left_s -= t;
    if (t < phase.duration_s) return now;
  }
  return {target, 0.0, 0.0};
}

Ramp speed_ramp(double speed_mps, double target_mps, double dt_s, const Limits& limits) {
  const double rate = speed_rate_mps2(speed_mps, target_mps, limits);
  const double ramp_s = std::min(dt_s, (target_mps - speed_mps) / rate);
  const double reached_mps = ramp_s < dt_s ? target_mps : speed_mps + rate * ramp_s;
  return {reached_mps, (speed_mps + 0.5 * rate * ramp_s) * ramp_s + reached_mps * (dt_s - ramp_s)};
}

double stopping_distance_m(double speed_mps, const Limits& limits) {
  return speed_mps * speed_mps / (2.0 * limits.deceleration_mps2);
}

double turn_rate_radps(double speed_mps, const Limits& limits) {
  return std::min(speed_mps / limits.turning_radius_m, limits.turn_rate_radps);
}

double turning_circle_m(double speed_mps, const Limits& limits) {
  return std::max(limits.turning_radius_m, speed_mps / limits.turn_rate_radps);
}

State advance(const State& state, const Command& command, double dt_s, const Limits& limits) {
  State next = std::isinf(limits.turn_acceleration_radps2) ? advance_level(state, command, dt_s, limits)
                                                           : advance_with_inertia(state, command, dt_s, limits);
  const Moving up = approach({state.position_enu_m.z(), state.climb_mps}, command.height_m, dt_s,
                             limits.vertical_speed_mps, limits.vertical_acceleration_mps2);
  next.position_enu_m.z() = up.value;
  next.climb_mps = up.rate;
  return next;
}

frames::MovingPose moving_pose(const State& state, const Command& command, const Limits& limits) {
  const double along =
      state.speed_mps == command.speed_mps ? 0.0 : speed_rate_mps2(state.speed_mps, command.speed_mps, limits);
  const Moving turn = turn_now(state, command, along, limits);

  double climb_mps = state.climb_mps, climb_mps2 = 0.0;
  const double way_up_m = command.height_m - state.position_enu_m.z();
  if (std::isinf(limits.vertical_acceleration_mps2)) {
    climb_mps = way_up_m == 0.0 ? 0.0 : std::copysign(limits.vertical_speed_mps, way_up_m);
  } else {
    climb_mps2 = approach({state.position_enu_m.z(), climb_mps}, command.height_m, 0.0, limits.vertical_speed_mps,
                          limits.vertical_acceleration_mps2)
                     .acceleration;
  }

  frames::MovingPose moving;
  moving.pose.position_enu_m = state.position_enu_m;
  moving.pose.enu_from_body = frames::enu_from_body({state.heading_rad, 0.0, 0.0});
  moving.velocity_enu_mps = state.speed_mps * forward(state.heading_rad) + climb_mps * Vec3::UnitZ();
  moving.acceleration_enu_mps2 = along * forward(state.heading_rad) +
                                 state.speed_mps * turn.rate * starboard(state.heading_rad) +
                                 climb_mps2 * Vec3::UnitZ();
  moving.angular_rate_body_radps = turn.rate * Vec3::UnitZ();
  moving.angular_acceleration_body_radps2 = turn.acceleration * Vec3::UnitZ();
  return moving;
}

Moving Sinusoid::at(double t_s) const {
  const double omega = 2.0 * std::numbers::pi / period_s, phase = omega * t_s + phase_rad;
  const double value = amplitude * std::sin(phase);
  return {value, amplitude * omega * std::cos(phase), -omega * omega * value};
}

Excursion Waves::at(double t_s) const {
  Excursion off;
  off.roll_rad = roll_rad.at(t_s);
  off.heave_m = heave_m.at(t_s);
  return off;
}

}  // namespace ensonify::motion

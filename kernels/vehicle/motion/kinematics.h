#pragma once

#include <limits>

#include "kernels/vehicle/motion/excursion.h"

/// Motion of a vehicle that obeys its commands as well as its limits allow: uniform acceleration along the path and in
/// the vertical (the SUVAT equations of school physics), and a turning circle of fixed radius. No forces, no slip.
namespace ensonify::motion {

/// Value and rate of a height or a heading after dt on its quickest way to `target`, at rest there, and the
/// acceleration in force from then on: full acceleration, then the highest rate, then full deceleration. What moves the
/// wrong way, or too fast to stop in time, is braked first and then comes back. Exact, so one step of dt equals any
/// number of steps that sum to dt. `fastest` and `acceleration` must be above 0, in the units of the value per second
/// and per second squared; an infinite acceleration changes the rate at once.
Moving approach(const Moving& from, double target, double dt_s, double fastest, double acceleration);

inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();

struct Limits {
  double acceleration_mps2 = 0.2;                  // > 0, speeding up
  double deceleration_mps2 = 0.2;                  // > 0, slowing down
  double turning_radius_m = 10.0;                  // > 0; turn rate = speed / radius, but
  double turn_rate_radps = kUnlimited;             // > 0, not more than this: fast vehicles turn on a wider circle
  double turn_acceleration_radps2 = kUnlimited;    // > 0; unlimited: turns begin and end at once
  double vertical_speed_mps = 0.5;                 // > 0, up and down
  double vertical_acceleration_mps2 = kUnlimited;  // > 0; unlimited: climbs and dives begin and end at once
};

struct Command {
  double heading_rad = 0.0;  // grid
  double speed_mps = 0.0;    // >= 0, through the water
  double height_m = 0.0;     // of the reference point, ENU z (depth below the world's zero is -height)
};

struct State {
  frames::Vec3 position_enu_m = frames::Vec3::Zero();
  double heading_rad = 0.0;  // grid, [0, 2 pi)
  double speed_mps = 0.0;    // along the heading, through the water
  double climb_mps = 0.0;    // up; stays 0 where the vertical acceleration is unlimited
  double turn_radps = 0.0;   // to starboard; stays 0 where the turn acceleration is unlimited
};

struct Ramp {
  double speed_mps;
  double distance_m;
};

/// Speed after dt and the distance covered, accelerating uniformly until the target speed is reached and holding it
/// then.
Ramp speed_ramp(double speed_mps, double target_mps, double dt_s, const Limits& limits);

/// Distance to a stop, v^2 / (2 a).
double stopping_distance_m(double speed_mps, const Limits& limits);

/// Rate of turn at a speed, speed / radius up to the limit, and the radius of the circle that this makes.
double turn_rate_radps(double speed_mps, const Limits& limits);
double turning_circle_m(double speed_mps, const Limits& limits);

/// The state after dt under a constant command. Exact: where the radius limits the turn, the path is an arc of the
/// turning circle; where the turn rate does, heading and speed are linear in time and the path is their integral in
/// closed form; then a straight line. The shorter way round is taken, to starboard when the command is dead astern. The
/// vertical is the quickest way to the commanded height at rest. So one step of dt equals any number of steps that sum
/// to dt. At rest the heading stays.
///
/// With a limited turn acceleration the heading takes the quickest way to the commanded one, exact at a constant speed;
/// the path is its integral over pieces of 10 ms or less, which other pieces change by less than 1e-6 m.
State advance(const State& state, const Command& command, double dt_s, const Limits& limits);

/// Pose, velocity, acceleration and turn rates of a vehicle under way, level.
frames::MovingPose moving_pose(const State& state, const Command& command, const Limits& limits);

/// A regular wave: amplitude * sin(2 pi t / period + phase). A zero amplitude is no motion.
struct Sinusoid {
  double amplitude = 0.0;  // rad for roll, m for heave
  double period_s = 1.0;   // > 0
  double phase_rad = 0.0;

  Moving at(double t_s) const;
};

struct Waves {
  Sinusoid roll_rad;  // starboard down
  Sinusoid heave_m;   // up

  Excursion at(double t_s) const;
};

}  // namespace ensonify::motion

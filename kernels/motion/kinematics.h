#pragma once

#include "kernels/frames/pose.h"

/// Motion of a vehicle that obeys its commands as well as its limits allow: uniform acceleration along the path (the
/// SUVAT equations of school physics) and a turning circle of fixed radius. No forces, no slip, no current.
namespace ensonify::motion {

struct Limits {
  double acceleration_mps2 = 0.2;   // > 0, speeding up
  double deceleration_mps2 = 0.2;   // > 0, slowing down
  double turning_radius_m = 10.0;   // > 0; turn rate = speed / radius
  double vertical_speed_mps = 0.5;  // > 0, up and down
};

struct Command {
  double heading_rad = 0.0;  // grid
  double speed_mps = 0.0;    // >= 0, over ground
  double height_m = 0.0;     // of the reference point, ENU z (depth below the world's zero is -height)
};

struct State {
  frames::Vec3 position_enu_m = frames::Vec3::Zero();
  double heading_rad = 0.0;  // grid, [0, 2 pi)
  double speed_mps = 0.0;    // along the heading
};

struct Ramp {
  double speed_mps;
  double distance_m;
};

/// Speed after dt and the distance covered, accelerating uniformly until the target speed is met and holding it then.
Ramp speed_ramp(double speed_mps, double target_mps, double dt_s, const Limits& limits);

/// Distance to a stop, v^2 / (2 a).
double stopping_distance_m(double speed_mps, const Limits& limits);

/// The state after dt under a constant command. Exact: the path is an arc of the turning circle, the shorter way (to
/// starboard when the command is dead astern), then a straight line; its length is speed_ramp's distance whatever the
/// speed did. So one step of dt equals any number of steps that sum to dt. At rest the heading stays.
State advance(const State& state, const Command& command, double dt_s, const Limits& limits);

/// A motion superimposed by waves: amplitude * sin(2 pi t / period + phase). A zero amplitude is no motion.
struct Sinusoid {
  double amplitude = 0.0;  // rad for roll, m for heave
  double period_s = 1.0;   // > 0
  double phase_rad = 0.0;

  double value(double t_s) const;
  double rate(double t_s) const;  // d value / dt
};

struct Waves {
  Sinusoid roll_rad;  // starboard down
  Sinusoid heave_m;   // up
};

/// Pose, velocity and turn rate at sim time t of a vehicle under way in waves. Pitch is zero.
frames::MovingPose moving_pose(const State& state, const Command& command, const Waves& waves, double t_s,
                               const Limits& limits);

}  // namespace ensonify::motion

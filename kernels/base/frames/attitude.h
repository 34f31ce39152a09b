#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

namespace ensonify::frames {

using Vec3 = Eigen::Vector3d;
using Vec2 = Eigen::Vector2d;

/// A rotation. Named target_from_source: `v_enu = enu_from_body * v_body`.
using Quaternion = Eigen::Quaterniond;

/// Attitude of a body (FRD: forward, starboard, down) in the world (ENU), as sailors say it.
struct Attitude {
  double heading_rad = 0.0;  // clockwise from grid north (the world's y axis)
  double pitch_rad = 0.0;    // bow up
  double roll_rad = 0.0;     // starboard down (port up)
};

/// Yaw about down, then pitch about starboard, then roll about forward: the aerospace sequence, in NED, turned to ENU.
Quaternion enu_from_body(const Attitude& attitude);

/// The inverse. heading in [0, 2 pi), pitch in [-pi/2, pi/2], roll in (-pi, pi]; at pitch +-90 deg roll is 0 by choice.
Attitude attitude_of(const Quaternion& enu_from_body);

/// World axes of a body lying level with its bow to north: enu_from_ned (a constant).
Quaternion enu_from_ned();

/// [w, x, y, z] with unit length and w >= 0, as messages carry a rotation (q and -q are the same rotation).
std::array<double, 4> wxyz_of(const Quaternion& q);

/// From [w, x, y, z] of any non-zero length.
Quaternion quaternion_of(const std::array<double, 4>& wxyz);

/// Unit length, w >= 0 (when w is 0, the first non-zero of x, y, z is positive).
Quaternion canonical(const Quaternion& q);

/// An angle brought to (-pi, pi].
double wrap_pi(double angle_rad);

/// An angle brought to [0, 2 pi).
double wrap_two_pi(double angle_rad);

/// Angular velocity about the body's axes (FRD), rad/s, of a body at `attitude` whose angles change at `rates`.
Vec3 body_rates_radps(const Attitude& attitude, const Attitude& rates_radps);

}  // namespace ensonify::frames

#pragma once

#include <cmath>

#include "kernels/instruments/inertial/strapdown.h"

/// Growth of the errors of an unaided inertial system, in closed form: on a resting sphere, level, at rest or on a
/// straight course, height held, each error alone [Titterton2004, ch. 12; Groves2013, ch. 5.7].
namespace ensonify::inertial {

/// The sphere of the closed forms. An error in tilt is pulled back by the place it leads to, as by a pendulum of the
/// Earth's radius (Schuler): every drift below swings with this rate.
struct SchulerSphere {
  double gravity_mps2 = 9.80665;
  double radius_m = 6378137.0;

  double rate_radps() const { return std::sqrt(gravity_mps2 / radius_m); }  // 1.2400e-3
  double period_s() const { return 2.0 * std::acos(-1.0) / rate_radps(); }  // 84.45 min
};

/// A sphere that does not turn: where the closed forms hold.
inline Earth resting_sphere(double radius_m, double gravity_mps2) {
  return {radius_m, 0.0, 0.0, gravity_mps2 * (radius_m * radius_m), gravity_mps2, 0.0};
}

/// Drift by a level accelerometer's constant bias, along its axis: b t^2 / 2 at first.
double accelerometer_bias_drift_m(const SchulerSphere& sphere, double bias_mps2, double time_s);

/// Drift by a level gyro's constant bias, across its axis: g e t^3 / 6 at first.
double gyro_bias_drift_m(const SchulerSphere& sphere, double bias_radps, double time_s);

/// Drift by a tilt at the start: g phi t^2 / 2 at first.
double tilt_drift_m(const SchulerSphere& sphere, double tilt_rad, double time_s);

/// Across the track, of a wrong heading on a straight course.
double heading_drift_m(double speed_mps, double heading_error_rad, double time_s);

/// Standard deviation that white noise of a level accelerometer leaves: N sqrt(t^3 / 3) at first. N in m/s/sqrt(s).
double velocity_random_walk_drift_m(const SchulerSphere& sphere, double random_walk, double time_s);

/// Standard deviation that white noise of a level gyro leaves: g N sqrt(t^5 / 20) at first. N in rad/sqrt(s).
double angle_random_walk_drift_m(const SchulerSphere& sphere, double random_walk, double time_s);

}  // namespace ensonify::inertial

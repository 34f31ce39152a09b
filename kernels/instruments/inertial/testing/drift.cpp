#include "kernels/instruments/inertial/testing/drift.h"

namespace ensonify::inertial {

double accelerometer_bias_drift_m(const SchulerSphere& sphere, double bias_mps2, double time_s) {
  const double w = sphere.rate_radps(), half = std::sin(0.5 * w * time_s);
  return bias_mps2 / (w * w) * 2.0 * half * half;  // 1 - cos wt
}

double gyro_bias_drift_m(const SchulerSphere& sphere, double bias_radps, double time_s) {
  const double w = sphere.rate_radps();
  return sphere.radius_m * bias_radps * (time_s - std::sin(w * time_s) / w);
}

double tilt_drift_m(const SchulerSphere& sphere, double tilt_rad, double time_s) {
  const double half = std::sin(0.5 * sphere.rate_radps() * time_s);
  return sphere.radius_m * tilt_rad * 2.0 * half * half;
}

double heading_drift_m(double speed_mps, double heading_error_rad, double time_s) {
  return speed_mps * time_s * std::sin(heading_error_rad);
}

double velocity_random_walk_drift_m(const SchulerSphere& sphere, double random_walk, double time_s) {
  // A unit of velocity at time s moves the place at t by sin(w (t - s)) / w; squares summed up over s.
  const double w = sphere.rate_radps();
  return random_walk / w * std::sqrt(0.5 * time_s - std::sin(2.0 * w * time_s) / (4.0 * w));
}

double angle_random_walk_drift_m(const SchulerSphere& sphere, double random_walk, double time_s) {
  // A unit of tilt at time s moves the place at t by R (1 - cos w (t - s)); squares summed up over s.
  const double w = sphere.rate_radps(), wt = w * time_s;
  const double sum = 1.5 * wt - 2.0 * std::sin(wt) + 0.25 * std::sin(2.0 * wt);
  return sphere.radius_m * random_walk * std::sqrt(sum / w);
}

}  // namespace ensonify::inertial

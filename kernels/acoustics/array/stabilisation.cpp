#include "kernels/acoustics/array/stabilisation.h"

#include <cmath>

namespace ensonify::array {

using frames::Quaternion;
using frames::Vec3;

Quaternion held_from_head(const Stabilisation& stabilisation, const frames::Attitude& head_measured,
                          double reference_heading_rad) {
  const frames::Attitude counted{
      .heading_rad = stabilisation.yaw ? head_measured.heading_rad - reference_heading_rad : 0.0,
      .pitch_rad = stabilisation.pitch ? head_measured.pitch_rad : 0.0,
      .roll_rad = stabilisation.roll ? head_measured.roll_rad : 0.0};
  return frames::enu_from_ned().conjugate() * frames::enu_from_body(counted);
}

Vec3 direction_held(double across_rad, double tilt_rad) {
  return {std::sin(tilt_rad), std::cos(tilt_rad) * std::sin(across_rad), std::cos(tilt_rad) * std::cos(across_rad)};
}

double transmit_sine(const Quaternion& held_from_head, const Vec3& direction) {
  return (held_from_head * Vec3::UnitX()).dot(direction);
}

double across_sine(const Quaternion& held_from_head, const Vec3& direction) {
  return (held_from_head * Vec3::UnitY()).dot(direction);
}

std::optional<Vec3> fan_direction(const Quaternion& held_from_head, double sin_transmit, double across_rad) {
  // axis . (sin t, cos t sin a, cos t cos a) = X sin t + q cos t = h sin(t + delta) must be the sine.
  const Vec3 axis = held_from_head * Vec3::UnitX();
  const double q = axis.y() * std::sin(across_rad) + axis.z() * std::cos(across_rad);
  const double h = std::hypot(axis.x(), q);
  if (!(std::abs(sin_transmit) <= h)) return std::nullopt;
  return direction_held(across_rad, std::asin(sin_transmit / h) - std::atan2(q, axis.x()));
}

std::optional<Vec3> cone_intersection(const Vec3& axis_transmit, double sin_transmit, const Vec3& axis_receive,
                                      double sin_receive) {
  const double between = axis_transmit.dot(axis_receive);
  const double square = 1.0 - between * between;  // of the sine between both axes
  const Vec3 in_plane =
      ((sin_transmit - between * sin_receive) * axis_transmit + (sin_receive - between * sin_transmit) * axis_receive) /
      square;
  const double out_of_plane_squared = 1.0 - in_plane.squaredNorm();
  if (!(out_of_plane_squared >= 0.0)) return std::nullopt;
  return in_plane + std::sqrt(out_of_plane_squared) * axis_transmit.cross(axis_receive).normalized();
}

double true_sine(double sin_commanded, double used_mps, double true_mps) { return sin_commanded * true_mps / used_mps; }

}  // namespace ensonify::array

#include "kernels/base/frames/attitude.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ensonify::frames {

constexpr double kPi = std::numbers::pi;

Quaternion enu_from_ned() { return {0.0, std::numbers::sqrt2 / 2.0, std::numbers::sqrt2 / 2.0, 0.0}; }

Quaternion enu_from_body(const Attitude& attitude) {
  const Quaternion ned_from_body = Eigen::AngleAxisd(attitude.heading_rad, Vec3::UnitZ()) *
                                   Eigen::AngleAxisd(attitude.pitch_rad, Vec3::UnitY()) *
                                   Eigen::AngleAxisd(attitude.roll_rad, Vec3::UnitX());
  return canonical(enu_from_ned() * ned_from_body);
}

Attitude attitude_of(const Quaternion& enu_from_body) {
  const Eigen::Matrix3d ned_from_body = (enu_from_ned().conjugate() * enu_from_body.normalized()).toRotationMatrix();
  const double sin_pitch = std::clamp(-ned_from_body(2, 0), -1.0, 1.0);
  if (std::abs(sin_pitch) > 1.0 - 1e-12) {  // heading and roll turn about the same axis: all of it is called heading
    return {wrap_two_pi(std::atan2(-ned_from_body(0, 1), ned_from_body(1, 1))), std::asin(sin_pitch), 0.0};
  }
  return {wrap_two_pi(std::atan2(ned_from_body(1, 0), ned_from_body(0, 0))), std::asin(sin_pitch),
          std::atan2(ned_from_body(2, 1), ned_from_body(2, 2))};
}

Quaternion canonical(const Quaternion& q) {
  const Quaternion unit = q.normalized();
  const double parts[] = {unit.w(), unit.x(), unit.y(), unit.z()};
  for (const double part : parts) {
    if (part > 0.0) return unit;
    if (part < 0.0) return {-unit.w() + 0.0, -unit.x(), -unit.y(), -unit.z()};
  }
  return unit;
}

std::array<double, 4> wxyz_of(const Quaternion& q) {
  const Quaternion c = canonical(q);
  return {c.w(), c.x(), c.y(), c.z()};
}

Quaternion quaternion_of(const std::array<double, 4>& wxyz) {
  return canonical(Quaternion(wxyz[0], wxyz[1], wxyz[2], wxyz[3]));
}

double wrap_pi(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * kPi);  // exact; in [-pi, pi]
  return wrapped <= -kPi ? kPi : wrapped;
}

double wrap_two_pi(double angle_rad) {
  const double wrapped = wrap_pi(angle_rad);
  if (wrapped >= 0.0) return wrapped + 0.0;
  const double positive = wrapped + 2.0 * kPi;
  return positive < 2.0 * kPi ? positive : 0.0;  // a tiny negative angle rounds up to a whole turn
}

Vec3 body_rates_radps(const Attitude& attitude, const Attitude& rates_radps) {
  const double sin_roll = std::sin(attitude.roll_rad), cos_roll = std::cos(attitude.roll_rad);
  const double sin_pitch = std::sin(attitude.pitch_rad), cos_pitch = std::cos(attitude.pitch_rad);
  const double heading_rate = rates_radps.heading_rad, pitch_rate = rates_radps.pitch_rad;
  return {rates_radps.roll_rad - heading_rate * sin_pitch, pitch_rate * cos_roll + heading_rate * cos_pitch * sin_roll,
          -pitch_rate * sin_roll + heading_rate * cos_pitch * cos_roll};
}

}  // namespace ensonify::frames

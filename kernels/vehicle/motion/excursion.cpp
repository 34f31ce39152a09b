#include "kernels/vehicle/motion/excursion.h"

#include <cmath>

namespace ensonify::motion {
namespace {

using frames::Vec3;

struct Turning {
  Vec3 rate_radps;
  Vec3 acceleration_radps2;
};

/// Body rates of the excursion's own turn, and their derivative.
Turning own_turn(const Moving& heading, const Moving& pitch, const Moving& roll) {
  const double sin_pitch = std::sin(pitch.value), cos_pitch = std::cos(pitch.value);
  const double sin_roll = std::sin(roll.value), cos_roll = std::cos(roll.value);
  const double p = roll.rate - heading.rate * sin_pitch;
  const double q = pitch.rate * cos_roll + heading.rate * cos_pitch * sin_roll;
  const double r = -pitch.rate * sin_roll + heading.rate * cos_pitch * cos_roll;

  // The derivatives of the three lines above; those of sin(roll) and cos(roll) gather to r and -q times the roll rate.
  const double p_dot = roll.acceleration - heading.acceleration * sin_pitch - heading.rate * pitch.rate * cos_pitch;
  const double q_dot = pitch.acceleration * cos_roll + heading.acceleration * cos_pitch * sin_roll -
                       heading.rate * pitch.rate * sin_pitch * sin_roll + roll.rate * r;
  const double r_dot = -pitch.acceleration * sin_roll + heading.acceleration * cos_pitch * cos_roll -
                       heading.rate * pitch.rate * sin_pitch * cos_roll - roll.rate * q;
  return {{p, q, r}, {p_dot, q_dot, r_dot}};
}

}  // namespace

Excursion Excursion::operator+(const Excursion& other) const {
  return {surge_m + other.surge_m,   sway_m + other.sway_m,       heave_m + other.heave_m,
          roll_rad + other.roll_rad, pitch_rad + other.pitch_rad, heading_rad + other.heading_rad};
}

frames::MovingPose superimpose(const frames::MovingPose& mean, const Excursion& off) {
  const frames::Quaternion& enu_from_mean = mean.pose.enu_from_body;
  const Vec3& omega = mean.angular_rate_body_radps;
  const Vec3& alpha = mean.angular_acceleration_body_radps2;

  const Vec3 s(off.surge_m.value, off.sway_m.value, 0.0);
  const Vec3 s_rate(off.surge_m.rate, off.sway_m.rate, 0.0);
  const Vec3 s_acceleration(off.surge_m.acceleration, off.sway_m.acceleration, 0.0);

  frames::MovingPose moving;
  moving.pose.position_enu_m = mean.pose.position_enu_m + enu_from_mean * s + off.heave_m.value * Vec3::UnitZ();
  moving.velocity_enu_mps =
      mean.velocity_enu_mps + enu_from_mean * (s_rate + omega.cross(s)) + off.heave_m.rate * Vec3::UnitZ();
  moving.acceleration_enu_mps2 =
      mean.acceleration_enu_mps2 +
      enu_from_mean * (s_acceleration + 2.0 * omega.cross(s_rate) + alpha.cross(s) + omega.cross(omega.cross(s))) +
      off.heave_m.acceleration * Vec3::UnitZ();

  const frames::Attitude turn{off.heading_rad.value, off.pitch_rad.value, off.roll_rad.value};
  const frames::Quaternion mean_from_body = frames::enu_from_ned().conjugate() * frames::enu_from_body(turn);
  const Turning own = own_turn(off.heading_rad, off.pitch_rad, off.roll_rad);
  const Vec3 mean_rate = mean_from_body.conjugate() * omega;
  moving.pose.enu_from_body = frames::canonical(enu_from_mean * mean_from_body);
  moving.angular_rate_body_radps = mean_rate + own.rate_radps;
  moving.angular_acceleration_body_radps2 =
      mean_from_body.conjugate() * alpha - own.rate_radps.cross(mean_rate) + own.acceleration_radps2;
  return moving;
}

Moving cubic_between(const Moving& from, const Moving& to, double length, double u) {
  const double h = length, chord = (to.value - from.value) / h;
  const double square = (3.0 * chord - 2.0 * from.rate - to.rate) / h;
  const double cube = (from.rate + to.rate - 2.0 * chord) / (h * h);
  return {from.value + u * (from.rate + u * (square + u * cube)), from.rate + u * (2.0 * square + 3.0 * u * cube),
          2.0 * square + 6.0 * u * cube};
}

}  // namespace ensonify::motion

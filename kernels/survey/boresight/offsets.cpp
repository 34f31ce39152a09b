#include "kernels/survey/boresight/offsets.h"

namespace ensonify::boresight {

namespace {

Quaternion turned_by(const Vec3& angle_rad) {
  const double angle = angle_rad.norm();
  if (angle == 0.0) return Quaternion::Identity();
  return Quaternion(Eigen::AngleAxisd(angle, angle_rad / angle));
}

}  // namespace

Placed place(const Sounding& sounding, const Offsets& offsets) {
  const Quaternion yaw(Eigen::AngleAxisd(offsets.yaw_rad, Vec3::UnitZ()));
  const Quaternion yaw_pitch = yaw * Quaternion(Eigen::AngleAxisd(offsets.pitch_rad, Vec3::UnitY()));
  const Quaternion mounting = yaw_pitch * Quaternion(Eigen::AngleAxisd(offsets.roll_rad, Vec3::UnitX()));
  const Quaternion since = turned_by(sounding.rate_enu_radps * offsets.attitude_latency_s);
  const Quaternion enu_from_body = since * sounding.enu_from_body;

  const Vec3 measured_body = sounding.enu_from_body.conjugate() * (sounding.place_enu_m - sounding.head_enu_m);
  const Vec3 away_body = mounting * measured_body;
  const Vec3 away_enu = enu_from_body * away_body;
  const Vec3 heave(0.0, 0.0, sounding.velocity_enu_mps.z()), course = sounding.velocity_enu_mps - heave;

  Placed placed;
  placed.place_enu_m =
      sounding.head_enu_m + course * offsets.position_latency_s + heave * offsets.attitude_latency_s + away_enu;
  placed.rates << course, heave + sounding.rate_enu_radps.cross(away_enu),
      enu_from_body * (yaw_pitch * Vec3::UnitX()).cross(away_body),
      enu_from_body * (yaw * Vec3::UnitY()).cross(away_body), enu_from_body * Vec3::UnitZ().cross(away_body);
  return placed;
}

}  // namespace ensonify::boresight

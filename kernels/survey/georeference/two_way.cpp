#include "kernels/survey/georeference/two_way.h"

#include "kernels/survey/georeference/sounding.h"

namespace ensonify::georeference {

using frames::Vec3;

Vec3 sounding_enu_m(const MeasuredEcho& measured, const refraction::SoundSpeedProfile& applied) {
  const Vec3 transmit_axis = measured.at_transmit.enu_from_head * Vec3::UnitX();
  const Vec3 receive_axis = measured.at_receive.enu_from_head * Vec3::UnitY();
  const Vec3 down = measured.at_transmit.enu_from_head * Vec3::UnitZ();
  const Vec3 middle = 0.5 * (measured.at_transmit.position_enu_m + measured.at_receive.position_enu_m);
  const Vec3 half_way = measured.at_receive.position_enu_m - middle;
  const frames::Quaternion enu_from_level = frames::enu_from_ned();

  MeasuredSounding from_middle;
  from_middle.face_depth_m = -middle.z();
  from_middle.face_speed_mps = measured.face_speed_mps;
  from_middle.two_way_s = measured.two_way_s;
  double sin_transmit = measured.sin_transmit, sin_receive = measured.sin_receive;
  Vec3 place = Vec3::Zero();
  // The corrections are of the order shift / range: four rounds leave its fourth power.
  for (int round = 0; round < 4; ++round) {
    const Vec3 direction = intersect_cones(transmit_axis, sin_transmit, receive_axis, sin_receive, down);
    from_middle.direction_level = enu_from_level.conjugate() * direction;
    place = enu_from_level * place_sounding(from_middle, applied);
    const Vec3 from_transmit = place + half_way, from_receive = place - half_way;
    const double out_m = from_transmit.norm(), back_m = from_receive.norm(), middle_m = place.norm();
    if (!(out_m > 0.0 && back_m > 0.0 && middle_m > 0.0)) break;
    sin_transmit = measured.sin_transmit - transmit_axis.dot(from_transmit / out_m - place / middle_m);
    sin_receive = measured.sin_receive - receive_axis.dot(from_receive / back_m - place / middle_m);
    from_middle.two_way_s = measured.two_way_s * 2.0 * middle_m / (out_m + back_m);
  }
  return middle + place;
}

}  // namespace ensonify::georeference

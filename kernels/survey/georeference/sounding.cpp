#include "kernels/survey/georeference/sounding.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "kernels/water/refraction/eigenray.h"

namespace ensonify::georeference {

using frames::Vec3;

Vec3 intersect_cones(const Vec3& transmit_axis, double sin_transmit, const Vec3& receive_axis, double sin_receive,
                     const Vec3& down) {
  const double cosine = transmit_axis.dot(receive_axis);  // between the axes
  const double area2 = 1.0 - cosine * cosine;
  if (!(area2 > 1e-12)) throw std::invalid_argument("intersect_cones: the axes must not be parallel");
  const Vec3 in_plane =
      ((sin_transmit - cosine * sin_receive) * transmit_axis + (sin_receive - cosine * sin_transmit) * receive_axis) /
      area2;
  const double length2 = in_plane.squaredNorm();
  if (length2 >= 1.0) return in_plane.normalized();
  Vec3 normal = transmit_axis.cross(receive_axis) / std::sqrt(area2);
  if (normal.dot(down) < 0.0) normal = -normal;
  return in_plane + std::sqrt(1.0 - length2) * normal;
}

Vec3 place_sounding(const MeasuredSounding& measured, const refraction::SoundSpeedProfile& applied) {
  const Vec3& d = measured.direction_level;
  const double horizontal = std::hypot(d.x(), d.y());
  const double cosine = horizontal * applied.speed_mps(measured.face_depth_m) / measured.face_speed_mps;
  const double depression = std::copysign(std::acos(std::min(cosine, 1.0)), d.z());
  const refraction::PathEnd end =
      refraction::path_at_time(applied, measured.face_depth_m, depression, 0.5 * measured.two_way_s);
  const double scale = horizontal > 0.0 ? end.horizontal_m / horizontal : 0.0;
  return {scale * d.x(), scale * d.y(), end.depth_m - measured.face_depth_m};
}

}  // namespace ensonify::georeference

#include "kernels/acoustics/trace/views.h"

#include <algorithm>

namespace ensonify::trace {

std::array<lod::View, 2> views_of(const TransmitVolume& volume, const frames::HeadPose& head, double max_range_m,
                                  const lod::Water& water, std::int32_t side_lobes) {
  const Eigen::Matrix3d enu_from_head = head.enu_from_head.toRotationMatrix();
  const bool forward = volume.axis == TransmitVolume::Axis::kForward;
  lod::View main, all;
  lod::Frustum& lobe = main.frustum;
  lobe.apex_enu_m = head.position_enu_m;
  lobe.axis_enu = enu_from_head.col(forward ? 0 : 2);
  lobe.zero_enu = enu_from_head.col(forward ? 2 : 0);
  lobe.side_enu = enu_from_head.col(1);
  lobe.max_range_m = max_range_m;
  lobe.water = water;
  all = main;
  lobe.low_sine = volume.sine.main_low;
  lobe.high_sine = volume.sine.main_high;
  lobe.low_angle_rad = volume.angle_rad.main_low;
  lobe.high_angle_rad = volume.angle_rad.main_high;
  all.frustum.low_sine = volume.sine.low;
  all.frustum.high_sine = volume.sine.high;
  all.frustum.low_angle_rad = volume.angle_rad.low;
  all.frustum.high_angle_rad = volume.angle_rad.high;
  all.level = side_lobes;
  return {main, all};
}

lod::Water water_above(const refraction::SoundSpeedProfile& profile, double head_depth_m, double deepest_m) {
  const double at_head = profile.speed_mps(head_depth_m), below = profile.speed_mps(deepest_m);
  lod::Water water{std::min(at_head, below), std::max(at_head, below), at_head};
  for (const refraction::Knot& knot : profile.knots()) {
    if (knot.depth_m > deepest_m) break;
    water.slowest_mps = std::min(water.slowest_mps, knot.speed_mps);
    water.fastest_mps = std::max(water.fastest_mps, knot.speed_mps);
  }
  return water;
}

}  // namespace ensonify::trace

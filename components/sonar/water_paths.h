#pragma once

#include "kernels/acoustics/trace/ray_distribution.h"
#include "kernels/acoustics/trace/scene.h"
#include "kernels/acoustics/trace/views.h"
#include "kernels/base/frames/pose.h"
#include "kernels/water/refraction/path_table.h"

namespace ensonify {

/// Rays through the water of a run: bent by its profile, or straight where the speed of sound is one everywhere or
/// refraction is switched off. Depths of the profile count from z = 0.
class WaterPaths {
 public:
  WaterPaths(const refraction::SoundSpeedProfile& profile, bool refraction)
      : profile_(profile), refracted_(refraction && profile.knots().size() > 1) {}

  /// The speed of sound at the head, m/s.
  double sound_speed_mps(const frames::HeadPose& head) const { return profile_.speed_mps(depth_m(head)); }

  /// Makes the seabed as a transmission needs it that sends rays into this volume from this pose: fine where it points,
  /// and its coordinates near the head.
  void adapt(trace::Scene& seabed, const frames::HeadPose& head, const trace::TransmitVolume& volume,
             double max_range_m) const {
    seabed.centre_near(head.position_enu_m.head<2>());
    if (!seabed.detail().enabled) return;
    const auto heights = seabed.heights_near(head.position_enu_m.head<2>(), max_range_m);
    const double deepest_m = heights ? -heights->lowest_m : depth_m(head);
    const lod::Water water = refracted_ ? trace::water_above(profile_, depth_m(head), deepest_m) : lod::Water{};
    seabed.adapt(trace::views_of(volume, head, max_range_m, water, seabed.detail().side_lobes));
  }

  /// trace::Scene::trace through this water. `table` becomes that of the paths from this head.
  void trace(const trace::Scene& seabed, const frames::HeadPose& head, const trace::Rays& rays, double max_range_m,
             trace::Hits& hits, refraction::PathTable& table) const {
    const auto range_m = static_cast<float>(max_range_m);
    if (!refracted_) return seabed.trace(head, rays, range_m, hits, sound_speed_mps(head));
    seabed.tabulate(profile_, head, depth_m(head), range_m, table);
    seabed.trace(head, rays, range_m, hits, table);
  }

  /// The table that a trace filled; null where paths are straight.
  const refraction::PathTable* refracted(const refraction::PathTable& table) const {
    return refracted_ ? &table : nullptr;
  }

 private:
  static double depth_m(const frames::HeadPose& head) { return -head.position_enu_m.z(); }

  refraction::SoundSpeedProfile profile_;
  bool refracted_;
};

}  // namespace ensonify

#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/acoustics/trace/parts.h"
#include "kernels/base/frames/attitude.h"

/// Code shared by straight and refracted rays. Private to this folder: it includes Embree.
namespace ensonify::trace {

constexpr std::size_t kPacket = 16;  // rays that Embree traces together
constexpr std::size_t kChunk = 32;   // packets per task: fixed, so the number of threads changes nothing

/// Rays of one packet, in Embree's frame. Lanes beyond `count` are off.
struct Packet {
  alignas(64) RTCRayHit16 rays;
  alignas(64) int on[kPacket];
  const Part* part_hit[kPacket];  // by each lane; null: nothing

  /// One lane, as far as tfar_m.
  void set(std::size_t lane, const frames::Vec3& start, const frames::Vec3& direction, float tfar_m) {
    on[lane] = -1;
    part_hit[lane] = nullptr;
    rays.ray.org_x[lane] = static_cast<float>(start.x());
    rays.ray.org_y[lane] = static_cast<float>(start.y());
    rays.ray.org_z[lane] = static_cast<float>(start.z());
    rays.ray.dir_x[lane] = static_cast<float>(direction.x());
    rays.ray.dir_y[lane] = static_cast<float>(direction.y());
    rays.ray.dir_z[lane] = static_cast<float>(direction.z());
    rays.ray.tnear[lane] = 0.0F;
    rays.ray.tfar[lane] = tfar_m;
    rays.ray.time[lane] = 0.0F;
    rays.ray.mask[lane] = ~0U;
    rays.ray.id[lane] = 0;
    rays.ray.flags[lane] = 0;
    rays.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }
  void switch_off(std::size_t lane) {
    set(lane, frames::Vec3::Zero(), frames::Vec3::UnitZ(), 0.0F);
    on[lane] = 0;
  }

  /// The nearest facet for each lane.
  void intersect(const PartTree& mesh, PartTree::Of of = PartTree::Of::kAll) {
    mesh.intersect(on, rays, of);
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      if (rays.hit.instID[0][lane] != RTC_INVALID_GEOMETRY_ID) part_hit[lane] = &mesh.part(rays.hit.instID[0][lane]);
    }
  }

  /// Lets the lanes that hit a facet of the contributor `behind` go on to the first that is of another.
  template <class ContributorAt>  // (lane): of what it hit
  void pass(const PartTree& mesh, std::uint32_t behind, const float (&tfar_m)[kPacket],
            const ContributorAt& contributor_at) {
    constexpr float kPassed_m = 1e-3F;
    alignas(64) int going[kPacket];
    for (;;) {
      bool any = false;
      for (std::size_t lane = 0; lane < kPacket; ++lane) {
        going[lane] = on[lane] != 0 && part_hit[lane] && contributor_at(lane) == behind ? -1 : 0;
        if (going[lane] == 0) continue;
        any = true;
        const float at_m = rays.ray.tfar[lane];
        rays.ray.tnear[lane] = std::max(at_m + kPassed_m, std::nextafter(at_m, std::numeric_limits<float>::max()));
        rays.ray.tfar[lane] = tfar_m[lane];
        rays.hit.geomID[lane] = rays.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
        part_hit[lane] = nullptr;
        if (rays.ray.tnear[lane] >= tfar_m[lane]) going[lane] = 0;
      }
      if (!any) return;
      mesh.intersect(going, rays);
      for (std::size_t lane = 0; lane < kPacket; ++lane) {
        if (going[lane] != 0 && rays.hit.instID[0][lane] != RTC_INVALID_GEOMETRY_ID)
          part_hit[lane] = &mesh.part(rays.hit.instID[0][lane]);
      }
    }
  }

  /// Unit normal of the facet that a lane hit; either side.
  frames::Vec3 normal(std::size_t lane) const {
    return frames::Vec3(rays.hit.Ng_x[lane], rays.hit.Ng_y[lane], rays.hit.Ng_z[lane]).normalized();
  }
};

}  // namespace ensonify::trace

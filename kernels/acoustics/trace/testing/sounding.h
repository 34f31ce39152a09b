#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "kernels/acoustics/trace/ray_distribution.h"

/// What a head of 1 degree x 1 degree, 20 m above a seabed, sends out and hits: for tests of its rays.
namespace ensonify::trace::sounding {

inline constexpr double kDegree = std::numbers::pi / 180.0;
inline constexpr float kFar_m = 150.0F;
inline constexpr double kNull = 1.0 / 50;  // sine of the first null of 50 wavelengths
inline constexpr double kSwath_rad = 65 * kDegree;
inline constexpr double kDepth_m = 20.0;
/// Level, to the north, where no post is.
inline const frames::HeadPose kHead{{0.1, 0.2, 0.0}, frames::enu_from_ned()};

/// A head of 1 degree x 1 degree, with rays 2.5 degrees beyond its outermost beam as heads have them.
inline TransmitVolume mills_cross() { return mills_cross_volume(50, 50, kSwath_rad + 2.5 * kDegree); }

inline double flat(double, double) { return -kDepth_m; }

struct Sounding {
  Rays rays;
  Hits hits;
  double share = 1.0;
};

/// Through water where paths are straight, or that of a table.
inline Sounding trace_rays(const Scene& scene, const RayDistribution& distribution, const frames::HeadPose& head,
                           const Targets& targets, const refraction::PathTable* water = nullptr) {
  const auto trace = [&](const Rays& rays, Hits& hits) {
    water != nullptr ? scene.adapted().trace(head, rays, kFar_m, hits, *water)
                     : scene.adapted().trace(head, rays, kFar_m, hits);
  };
  RayDistribution::Plan plan;
  RayDistribution::Batch all;
  distribution.aim(head, {}, targets, kFar_m, water, trace, plan);
  distribution.trace(plan, 0, plan.rays(), trace, all);
  return {std::move(all.rays), std::move(all.hits), plan.share()};
}

inline Sounding trace_ping(const Scene& scene, const RaySettings& settings, std::uint64_t seed = 1,
                           const frames::HeadPose& head = kHead, const TransmitVolume& volume = mills_cross()) {
  return trace_rays(scene, {volume, settings, random::Stream{seed, "rays"}}, head, scene.objects());
}

inline Scene scene_of(const std::function<double(double, double)>& height, double spacing_m = 0.25, int cells = 800) {
  Scene scene({0, 0});
  const double corner = -0.5 * cells * spacing_m;
  scene.insert({0, 0}, terrain::sample_tile({.origin_enu_m = {corner, corner}, .spacing_m = spacing_m, .cells = cells},
                                            {0, 0}, height));
  return scene;
}

inline double across_rad(const Ray& ray) { return std::atan2(ray.direction_head.y(), ray.direction_head.z()); }

}  // namespace ensonify::trace::sounding

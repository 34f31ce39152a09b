#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "kernels/acoustics/trace/testing/sounding.h"
#include "kernels/seabed/relief/bodies.h"
#include "kernels/seabed/relief/spectral_surface.h"

namespace ensonify::trace::sounding {

/// Below which relief is smooth: four posts, or less than one.
inline constexpr double kFourPosts_m = 1.0, kRough_m = 0.1;

/// Relief of 0.3 m rms and some 200 boulders per hectare.
inline Scene strewn_with_boulders(std::uint64_t seed, double spacing_m, int cells,
                                  double smooth_below_m = kFourPosts_m) {
  const relief::Bodies boulders(
      {.per_km2 = 20000, .smallest_radius_m = 0.5, .largest_radius_m = 2.0, .size_exponent = 1.0}, spacing_m, seed,
      "boulders");
  const relief::SpectralSurface relief({.rms_m = 0.3, .outer_scale_m = 40.0, .inner_scale_m = smooth_below_m},
                                       spacing_m, seed, "relief");
  const relief::Window posts{0, -cells / 2, -cells / 2, cells + 1, cells + 1};
  std::vector<float> body_m(posts.size()), relief_m(posts.size());
  boulders.fill(posts, body_m);
  relief.fill(posts, relief_m);
  return scene_of(
      [&](double x, double y) {
        const auto k = posts.node(static_cast<int>(std::lround(x / spacing_m) - posts.east),
                                  static_cast<int>(std::lround(y / spacing_m) - posts.north));
        return -kDepth_m + static_cast<double>(body_m[k]) + static_cast<double>(relief_m[k]);
      },
      spacing_m, cells);
}

}  // namespace ensonify::trace::sounding

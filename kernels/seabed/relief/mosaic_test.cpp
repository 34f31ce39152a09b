// Whole seabeds against what measured ones show: the ranges are those of grids of real surveys.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/seabed/relief/mask.h"
#include "kernels/seabed/relief/ripples.h"
#include "kernels/seabed/relief/seabed.h"
#include "kernels/seabed/relief/spectral_surface.h"
#include "kernels/seabed/statistics/power_spectrum.h"
#include "kernels/seabed/statistics/surface.h"

using namespace ensonify::relief;
using namespace ensonify::relief_statistics;

namespace {

constexpr int kPosts = 1024;

Field field_of(const SpectralSurface& surface, const Field& amplitude = nullptr) {
  return [surface, amplitude](const Window& w, std::span<float> z) { surface.fill(w, z, amplitude); };
}

Surface square(const Seabed& seabed, double spacing_m) {
  Surface z{kPosts, kPosts, spacing_m, std::vector<float>(static_cast<std::size_t>(kPosts) * kPosts)};
  seabed.fill({0, 0, 0, kPosts, kPosts}, z.height_m, {});
  return z;
}

struct Measured {
  Patchiness patches;
  double k2, exponent;
};

Measured measure(const Surface& z) {
  const double pi = std::numbers::pi;
  return {patchiness(z), scaling_exponents(z).k2(),
          fit_power_law(radial_spectrum(z, 256), 2 * pi / (64 * z.spacing_m), pi / (2 * z.spacing_m)).exponent};
}

/// Rock that stands out of a sand plain: the rock is a multifractal, sand fills what lies below its level. Both follow
/// long swells of the ground, so that smooth places slope too.
Seabed rock_and_sand(std::uint64_t seed) {
  const double spacing_m = 0.25;
  const SpectralSurface swell({.rms_m = 2.0, .hurst = 0.8, .outer_scale_m = 300.0, .inner_scale_m = 80.0}, spacing_m,
                              seed, "swell");
  const SpectralSurface rock({.rms_m = 1.5, .hurst = 0.625, .outer_scale_m = 150.0}, spacing_m, seed, "rock");
  const LognormalCascade cascade({.intermittency = 0.2, .outer_scale_m = 150.0}, spacing_m, seed, "rock");
  const SpectralSurface sand({.rms_m = 0.03, .hurst = 0.625, .outer_scale_m = 60.0}, spacing_m, seed, "sand");
  const Field rough = [cascade](const Window& w, std::span<float> m) { cascade.fill(w, m); };
  const Field base = sum({constant(-20.0F), field_of(swell)});
  return {base,
          nullptr,
          {{.height_m = field_of(rock, rough), .sediment = 1},
           {.height_m = sum({base, constant(0.3F), field_of(sand)}), .join = Layer::Join::kCover, .sediment = 2}}};
}

}  // namespace

TEST_CASE("rock with sand has the statistics of reefs; fractional Brownian relief does not") {
  for (const std::uint64_t seed : {1, 2}) {
    const Measured mixed = measure(square(rock_and_sand(seed), 0.25));
    INFO("seed " << seed << ": K2 " << mixed.k2 << ", exponent " << mixed.exponent << ", patch "
                 << mixed.patches.rms_over_median << ", p95/p5 " << mixed.patches.p95_over_p5 << ", bimodality "
                 << mixed.patches.bimodality << ", rms and slope " << mixed.patches.slope_correlation);
    CHECK(mixed.exponent > 3.1);
    CHECK(mixed.exponent < 3.5);
    CHECK(mixed.k2 > 0.10);
    CHECK(mixed.k2 < 0.35);
    CHECK(mixed.patches.rms_over_median > 2.3);
    CHECK(mixed.patches.rms_over_median < 12.0);
    CHECK(mixed.patches.p95_over_p5 > 14.0);
    CHECK(mixed.patches.p95_over_p5 < 80.0);
    CHECK(mixed.patches.bimodality >= 0.55);
    CHECK(mixed.patches.slope_correlation > 0.5);
    CHECK(mixed.patches.slope_correlation < 0.75);
  }
  const SpectralSurface plain({.rms_m = 1.5, .hurst = 0.625, .outer_scale_m = 4000.0}, 0.25, 1, "plain");
  const Measured fbm = measure(square({constant(-20.0F), nullptr, {{.height_m = field_of(plain)}}}, 0.25));
  CHECK(fbm.k2 < 0.02);
  CHECK(fbm.patches.rms_over_median < 1.2);
  CHECK(fbm.patches.bimodality < 0.4);
  CHECK(fbm.patches.p95_over_p5 < 3.0);
}

TEST_CASE("coral: a multifractal with steep-sided plates lies within what a reef measures") {
  const SpectralSurface reef({.rms_m = 0.25, .hurst = 0.645, .outer_scale_m = 8.0}, 0.01, 3, "coral");
  const LognormalCascade cascade({.intermittency = 0.2, .outer_scale_m = 8.0}, 0.01, 3, "coral");
  const SpectralSurface outline({.rms_m = 1.0, .hurst = 0.9, .outer_scale_m = 2.8, .inner_scale_m = 0.1}, 0.01, 3,
                                "plates");
  const Field rough = [&](const Window& w, std::span<float> m) { cascade.fill(w, m); };
  const Field plates = in_band(field_of(outline), {.low = 0.3, .softness = 0.2});
  const Seabed seabed(constant(-5.0F), nullptr,
                      {{.height_m = field_of(reef, rough)}, {.height_m = constant(0.31F), .mask = plates}});
  const Measured coral = measure(square(seabed, 0.01));
  INFO("K2 " << coral.k2 << ", exponent " << coral.exponent << ", patch " << coral.patches.rms_over_median
             << ", rms and slope " << coral.patches.slope_correlation);
  CHECK(coral.k2 > 0.25);
  CHECK(coral.k2 < 0.40);
  CHECK(coral.exponent > 3.1);  // 3.2 to 3.4, less what one surface's exponent scatters by
  CHECK(coral.exponent < 3.5);
  CHECK(coral.patches.rms_over_median > 2.0);
  CHECK(coral.patches.rms_over_median < 3.0);
  CHECK(coral.patches.slope_correlation > 0.6);
  CHECK(coral.patches.slope_correlation < 0.75);
}

TEST_CASE("neighbouring tiles share their edge bit-equal, in heights and classes") {
  const Seabed seabed = rock_and_sand(5);
  const Window west{0, -128, 0, 129, 129}, east{0, 0, 0, 129, 129};
  std::vector<float> left(west.size()), right(east.size());
  std::vector<std::uint8_t> left_class(west.size()), right_class(east.size());
  seabed.fill(west, left, left_class);
  seabed.fill(east, right, right_class);
  for (int j = 0; j < 129; ++j) {
    REQUIRE(left[west.node(128, j)] == right[east.node(0, j)]);
    REQUIRE(left_class[west.node(128, j)] == right_class[east.node(0, j)]);
  }
}

TEST_CASE("a bedform field is even within its class: K2 about 0, patches 1.0 to 1.2") {
  const Ripples dunes(
      {.wavelength_m = 10.0, .height_m = 0.3, .lee_fraction = 0.35, .disorder = 0.4, .height_ln_sd = 0.4}, 1.0, 4,
      "dunes");
  const SpectralSurface sand({.rms_m = 0.4, .hurst = 0.625, .outer_scale_m = 300.0}, 1.0, 4, "sand");
  const Field waves = [&](const Window& w, std::span<float> z) { dunes.fill(w, z); };
  const Measured field =
      measure(square({constant(-30.0F), nullptr, {{.height_m = field_of(sand)}, {.height_m = waves}}}, 1.0));
  INFO("K2 " << field.k2 << ", patch " << field.patches.rms_over_median);
  CHECK(std::abs(field.k2) < 0.05);
  CHECK(field.patches.rms_over_median > 1.0);
  CHECK(field.patches.rms_over_median < 1.2);
}

#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/seabed/relief/exponential.h"
#include "kernels/seabed/relief/seabed.h"
#include "kernels/seabed/relief/spectral_surface.h"
#include "kernels/seabed/relief/spline.h"
#include "kernels/seabed/relief/spline_variance.h"
#include "kernels/seabed/statistics/power_spectrum.h"
#include "kernels/seabed/statistics/surface.h"
#include "kernels/seabed/statistics/testing/exact_fbm.h"

using namespace ensonify::relief;
using namespace ensonify::relief_statistics;
using Catch::WithinAbs;

namespace {

Field field_of(const LognormalCascade& cascade) {
  return [&cascade](const Window& window, std::span<float> out) { cascade.fill(window, out); };
}

Surface square(const SpectralSurface& surface, const Field& amplitude, int posts) {
  Surface z{posts, posts, 1.0, std::vector<float>(static_cast<std::size_t>(posts) * static_cast<std::size_t>(posts))};
  surface.fill({0, 0, 0, posts, posts}, z.height_m, amplitude);
  return z;
}

}  // namespace

TEST_CASE("the fast exponential is the exponential") {
  for (float x = -80.0F; x <= 80.0F; x += 0.0371F)
    REQUIRE(exponential(x) == Approx(std::exp(static_cast<double>(x))).epsilon(1e-6));
  CHECK(std::isfinite(exponential(1e9F)));
}

TEST_CASE("a cascade has mean square 1 per level; its log variance gains k2 ln 2 an octave") {
  const double k2 = 0.2;
  for (const int level : {2, 4, 6}) {
    double square = 0.0, log = 0.0, log2 = 0.0;
    const int seeds = 60, nodes = 64;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const LognormalCascade cascade({.intermittency = k2, .outer_scale_m = 6.0 * 256}, 1.0, seed,
                                     "cascade");  // octaves 8, 7, ...
      std::vector<float> m(nodes * nodes);
      cascade.fill({level, 0, 0, nodes, nodes}, m);
      for (const float x : m) {
        square += x * x / (seeds * nodes * nodes);
        log += std::log(x) / (seeds * nodes * nodes);
        log2 += std::pow(std::log(x), 2) / (seeds * nodes * nodes);
      }
    }
    double variance = 0.0;  // octaves 8 to level + 1; the last refinements have not yet smoothed their noise wholly
    for (int down = 1; down <= 8 - level; ++down)
      variance += k2 * std::log(2.0) * variance_of_coefficients(down) / variance_of_coefficients(20);
    INFO("level " << level);
    // At least 60 * (64 / 2^(8 - level))^2 / 4 independent places; the mean square of a lognormal of this variance
    // scatters by sqrt(e^(4 var) - 1) of that: 4 sd below 0.3.
    CHECK(square == Approx(1.0).epsilon(0.3));
    CHECK(log2 - log * log == Approx(variance).epsilon(0.2));  // the coarsest octaves have 60 places only
    CHECK(log == Approx(-variance).epsilon(0.2));              // E m^2 = 1: mean of ln m = -variance
  }
}

TEST_CASE("exponents grow with intermittency as in a lognormal cascade, and D stays") {
  const double h = 0.625;
  constexpr double kOuter = 512.0;
  double plain_zeta_2 = 0.0;
  for (const double k2 : {0.0, 0.15, 0.3}) {
    ScalingExponents z;
    double mean_square = 0.0;
    const int surfaces = 12, posts = 512;
    for (std::uint64_t seed = 0; seed < surfaces; ++seed) {
      const SpectralSurface surface({.rms_m = 1.0, .hurst = h, .outer_scale_m = kOuter}, 1.0, seed, "rock");
      const LognormalCascade cascade({.intermittency = k2, .outer_scale_m = kOuter, .finest_level = 0}, 1.0, seed,
                                     "rock");
      const Surface heights = square(surface, field_of(cascade), posts);
      const auto one = scaling_exponents(heights);
      z.zeta_1 += one.zeta_1 / surfaces;
      z.zeta_2 += one.zeta_2 / surfaces;
      mean_square += structure_function(heights, 32, 2.0) / structure_m2(surface.spectrum(), 32.0) / surfaces;
    }
    if (k2 == 0.0) plain_zeta_2 = z.zeta_2;
    INFO("k2 " << k2 << ": zeta1 " << z.zeta_1 << ", zeta2 " << z.zeta_2 << ", K2 " << z.k2() << ", D " << mean_square);
    // K2 = intermittency in the limit of many octaves; with the six above lags of 1 to 32 posts, 0.55 to 0.8 of it.
    CHECK(z.k2() >= 0.55 * k2 - 0.015);
    CHECK(z.k2() <= 0.8 * k2 + 0.015);
    CHECK_THAT(z.zeta_2, WithinAbs(plain_zeta_2, 0.05));  // the spectrum's, whatever the intermittency
    CHECK(mean_square == Approx(1.0).epsilon(0.08 + 0.5 * k2));
  }
}

TEST_CASE("in a cascade roughness follows slope and patches differ; in plain relief not") {
  const SpectralSurface surface({.rms_m = 1.0, .hurst = 0.625, .outer_scale_m = 512.0}, 1.0, 3, "rock");
  const LognormalCascade cascade({.intermittency = 0.3, .outer_scale_m = 512.0}, 1.0, 3, "rock");
  const auto plain = patchiness(square(surface, nullptr, 512)),
             rough = patchiness(square(surface, field_of(cascade), 512));
  INFO("plain " << plain.rms_over_median << ' ' << plain.p95_over_p5 << ' ' << plain.slope_correlation << "; cascade "
                << rough.rms_over_median << ' ' << rough.p95_over_p5 << ' ' << rough.slope_correlation);
  CHECK(plain.rms_over_median < 1.1);
  CHECK(plain.slope_correlation < 0.15);
  CHECK(rough.rms_over_median > 1.5);
  CHECK(rough.slope_correlation > 0.4);
}

TEST_CASE("with a height gain high ground is rougher, and the variance stays") {
  double high = 0.0, low = 0.0, mean_square = 0.0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const SpectralSurface surface({.rms_m = 1.0, .hurst = 0.7, .outer_scale_m = 128.0}, 1.0, seed, "rock");
    const HeightGain gain(surface, 0.5);
    const Surface z = square(
        surface, [&](const Window& w, std::span<float> out) { gain.fill(w, out); }, 512);
    Patch patch;
    for (int row = 0; row + 9 <= 512; row += 9) {
      for (int column = 0; column + 9 <= 512; column += 9) {
        REQUIRE(patch_of(z, column, row, 9, patch));
        double square_sum = 0.0;
        for (const double r : patch.residual_m) square_sum += r * r;
        if (patch.mean_m > 0.7) high += square_sum / 400.0;
        if (patch.mean_m < -0.7) low += square_sum / 400.0;
      }
    }
    for (const float x : z.height_m) mean_square += x * x / (6 * 512.0 * 512.0);
  }
  CHECK(high > 3.0 * low);
  CHECK(mean_square == Approx(1.0).epsilon(0.15));  // 6 * 50 independent heights of a skewed law
}

TEST_CASE("amplitudes are the same in every window") {
  const LognormalCascade cascade({.intermittency = 0.3, .outer_scale_m = 200.0}, 0.5, 8, "w");
  const HeightGain gain(SpectralSurface({.rms_m = 1.0, .hurst = 0.5, .outer_scale_m = 90.0}, 0.5, 8, "w"), 0.4);
  const Field both = product({field_of(cascade), [&](const Window& w, std::span<float> out) { gain.fill(w, out); }});
  for (const int level : {0, 1, 3}) {
    const Window whole{level, -50, -20, 150, 140}, part{level, -7, 30, 40, 50};
    std::vector<float> all(whole.size()), some(part.size());
    both(whole, all);
    both(part, some);
    for (int j = 0; j < part.rows; ++j) {
      for (int i = 0; i < part.columns; ++i) REQUIRE(some[part.node(i, j)] == all[whole.node(i + 43, j + 50)]);
    }
  }
}

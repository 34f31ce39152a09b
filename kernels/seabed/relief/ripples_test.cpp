#include "kernels/seabed/relief/ripples.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

using namespace ensonify::relief;
using Catch::WithinAbs;

namespace {

constexpr double kPi = std::numbers::pi, kSpacing = 0.05;

std::vector<float> heights(const Ripples& ripples, const Window& window) {
  std::vector<float> out(window.size());
  ripples.fill(window, out);
  return out;
}

}  // namespace

TEST_CASE("without disorder every ripple has the set height, length and lee side") {
  for (const double lee : {0.5, 0.4, 0.32}) {
    const RippleParameters p{.wavelength_m = 2.0,
                             .height_m = 0.3,
                             .travel_heading_rad = kPi / 2,
                             .lee_fraction = lee,
                             .disorder = 0.0,
                             .height_ln_sd = 0.0};
    const Ripples ripples(p, kSpacing, 1, "train");
    const Window line{0, -80, 7, 161, 1};  // four waves eastward, 40 posts each
    const auto z = heights(ripples, line);
    const auto [low, high] = std::minmax_element(z.begin(), z.end());
    INFO("lee " << lee);
    CHECK(*high - *low ==
          Approx(0.3).epsilon(
              0.006));  // posts miss crest and trough by up to (pi / 40)^2 / 2 of a sine, more of a refracted one
    for (std::size_t i = 0; i + 40 < z.size(); ++i) CHECK_THAT(z[i + 40], WithinAbs(z[i], 1e-5));
    // From the crest eastward to the next trough lies the lee.
    const auto crest = std::max_element(z.begin(), z.begin() + 80), trough = std::min_element(crest, z.end());
    CHECK_THAT(static_cast<double>(trough - crest) / 40, WithinAbs(lee, 0.03));
    double steepest = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < 160; ++i) {
      steepest = std::max(steepest, (z[i] - z[i + 1]) / kSpacing);
      sum += z[i];
    }
    CHECK(steepest == Approx(ripples.steepest_lee()).epsilon(0.02));
    CHECK_THAT(sum / 160, WithinAbs(0.0, 1e-5));
  }
  // A symmetric wave's steepest slope is pi height / wavelength.
  CHECK(Ripples({.wavelength_m = 2.0, .height_m = 0.3}, kSpacing, 1, "s").steepest_lee() == Approx(kPi * 0.15));
}

TEST_CASE("crests run across the travel heading") {
  const RippleParameters p{
      .wavelength_m = 1.0, .height_m = 0.1, .travel_heading_rad = kPi / 6, .disorder = 0.0, .height_ln_sd = 0.0};
  const Ripples ripples(p, kSpacing, 1, "train");
  // Along the crest: heading 120 degrees; (sqrt(3) / 2, -1 / 2) of 200 posts is (173.2, -100): within 0.2 posts of it.
  const auto here = heights(ripples, {0, 30, 40, 8, 8}), there = heights(ripples, {0, 30 + 173, 40 - 100, 8, 8});
  for (std::size_t i = 0; i < here.size(); ++i) CHECK_THAT(there[i], WithinAbs(here[i], 0.05 * 2 * kPi * 0.2 * 0.05));
}

TEST_CASE("defects of a wholly disordered train have the density of zeros of Gaussian noise") {
  const RippleParameters p{.wavelength_m = 1.0, .height_m = 0.1, .disorder = 1.0, .patch_wavelengths = 1.6};
  double zeros = 0.0, area_m2 = 0.0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const Ripples ripples(p, 0.1, seed, "defects");
    REQUIRE(ripples.noise_length_m() == Approx(1.6));
    const Window window{0, 0, 0, 601, 601};
    std::vector<float> re(window.size()), im(window.size());
    ripples.phase(window, re, im);
    const auto turn = [&](int i, int j, int k, int l) {  // of the phase from one node to the next, within half a turn
      const std::complex<float> a(re[window.node(i, j)], im[window.node(i, j)]),
          b(re[window.node(k, l)], im[window.node(k, l)]);
      return std::arg(b * std::conj(a));
    };
    for (int j = 0; j < 600; ++j) {
      for (int i = 0; i < 600; ++i) {
        const float around =
            turn(i, j, i + 1, j) + turn(i + 1, j, i + 1, j + 1) + turn(i + 1, j + 1, i, j + 1) + turn(i, j + 1, i, j);
        zeros += std::abs(around) > 3.0F ? 1.0 : 0.0;
      }
    }
    area_m2 += 3600.0;
  }
  // 0.9508 / (2 pi length^2) = 0.0591 per m2: 850 of them; zeros repel, so their number scatters by less than sqrt(n).
  CHECK(zeros / area_m2 == Approx(0.9508 / (2 * kPi * 1.6 * 1.6)).epsilon(4.0 / std::sqrt(850.0)));
}

TEST_CASE("disorder keeps the mean height and bounds; few defects at little disorder") {
  const RippleParameters p{.wavelength_m = 1.0, .height_m = 0.1, .disorder = 0.25, .height_ln_sd = 0.0};
  const auto z = heights(Ripples(p, 0.1, 3, "some"), {0, 0, 0, 400, 400});
  double square = 0.0;
  for (const float x : z) {
    square += x * x / 160000.0;
    REQUIRE(std::abs(x) < 0.05 * std::sqrt(1.1) + 1e-6);
  }
  CHECK(std::sqrt(square) == Approx(0.1 / (2 * std::sqrt(2.0))).epsilon(0.05));
}

TEST_CASE("waves are the same in every window, and gone where nodes are too coarse") {
  const RippleParameters p{
      .wavelength_m = 3.0, .height_m = 0.2, .travel_heading_rad = 0.4, .lee_fraction = 0.35, .disorder = 0.6};
  const Ripples ripples(p, 0.1, 3, "some");
  const Window whole{0, -40, 100, 120, 90}, part{0, 13, 131, 31, 17};
  const auto all = heights(ripples, whole), some = heights(ripples, part);
  for (int j = 0; j < part.rows; ++j) {
    for (int i = 0; i < part.columns; ++i) REQUIRE(some[part.node(i, j)] == all[whole.node(i + 53, j + 31)]);
  }
  CHECK(heights(ripples, {3, 0, 0, 5, 5}) == std::vector<float>(25, 0.0F));
  CHECK_THROWS_WITH(Ripples({.lee_fraction = 0.1}, 0.1, 1, "x"),
                    "ripples: lee_fraction is 0.100000, allowed: 0.3 to 0.5");
}

TEST_CASE("Flemming's mean heights") {
  CHECK(flemming_height_m(10.0) == Approx(0.437).epsilon(0.01));
  CHECK(flemming_height_m(168.0) == Approx(4.3).epsilon(0.01));
}

#include "kernels/terrain/synthetic_seabed.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify::terrain;

/// What scenarios/bay describes.
static SyntheticSeabedParameters bay() {
  SyntheticSeabedParameters bay;
  bay.seed = 1;
  bay.reference_enu_m = {0, 0};
  bay.reference_depth_m = 20;
  bay.slope_rad = 0.022;
  bay.downhill_heading_rad = std::numbers::pi / 2;
  bay.ridge = {{-60, -200}, {80, 180}, 6.0, 40.0};
  bay.boulders = {20.0, 0.5, 2.0, 0.8};
  bay.relief = {0.1, 40.0, 5, 0.625};
  return bay;
}

TEST_CASE("without features the seabed is the plane it says") {
  const SyntheticSeabed seabed({.reference_enu_m = {10, 20}, .reference_depth_m = 15, .slope_rad = 0.1});
  CHECK(seabed.height_m(10, 20) == -15);
  CHECK(seabed.height_m(500, 30) == Approx(-15 - std::tan(0.1) * 10));  // deeper to north
}

TEST_CASE("a ridge has its height on its line and half of it half a width away") {
  SyntheticSeabedParameters p;
  p.ridge = {{0, -50}, {0, 50}, 4.0, 20.0};
  const SyntheticSeabed seabed(p);
  CHECK(seabed.height_m(0, 10) == Approx(-16));
  CHECK(seabed.height_m(10, 10) == Approx(-18));
  CHECK(seabed.height_m(0, 60) == Approx(-18));
  CHECK(seabed.sediment(5, 0) == Sediment::kRidge);
  CHECK(seabed.sediment(15, 0) == Sediment::kBase);
}

TEST_CASE("boulders come in the number asked for, and no larger") {
  SyntheticSeabedParameters p;
  p.boulders = {.per_hectare = 40, .smallest_radius_m = 1.0, .largest_radius_m = 1.0, .height_per_radius = 0.8};
  const SyntheticSeabed seabed(p);
  // Expected covered share of 1 hectare: 40 pi 1^2 / 1e4, less a little overlap (< 1 %). Over 16 ha the count is 640
  // with sd < 25, 4 %; the limit is 4 sd.
  int covered = 0, places = 0;
  for (double x = -200; x < 200; x += 0.4)
    for (double y = -200; y < 200; y += 0.4) {
      const double h = seabed.height_m(x, y) + 20;
      REQUIRE(h <= 0.8 + 1e-12);
      covered += h > 0;
      ++places;
    }
  CHECK(double(covered) / places == Approx(40 * std::numbers::pi / 1e4).epsilon(0.16));
}

TEST_CASE("relief has the rms asked for and no mean") {
  SyntheticSeabedParameters p;
  p.relief = {.rms_m = 0.2, .longest_wavelength_m = 8};
  const SyntheticSeabed seabed(p);
  double sum = 0, squares = 0;
  int n = 0;  // 400 m square holds 2500 of the longest waves: sd of the mean square about 3 %
  for (double x = -200; x < 200; x += 1.7)
    for (double y = -200; y < 200; y += 1.7, ++n) {
      const double h = seabed.height_m(x, y) + 20;
      sum += h;
      squares += h * h;
    }
  CHECK(sum / n == Approx(0).margin(0.02));
  CHECK(std::sqrt(squares / n) == Approx(0.2).epsilon(0.06));
}

TEST_CASE("the bay lies between 10 and 30 m") {
  const SyntheticSeabed seabed(bay());
  double shallowest = 1e9, deepest = 0;
  for (double x = -250; x <= 250; x += 1)
    for (double y = -225; y <= 225; y += 1) {
      shallowest = std::min(shallowest, -seabed.height_m(x, y));
      deepest = std::max(deepest, -seabed.height_m(x, y));
    }
  CHECK(shallowest > 10);
  CHECK(shallowest < 16);
  CHECK(deepest < 30);
  CHECK(deepest > 24);
}

TEST_CASE("another seed strews other boulders") {
  auto p = bay();
  const SyntheticSeabed a(p), same(p);
  p.seed = 2;
  const SyntheticSeabed b(p);
  int differ = 0;
  for (double x = -50; x < 50; x += 1) {
    REQUIRE(a.height_m(x, 3) == same.height_m(x, 3));
    differ += a.height_m(x, 3) != b.height_m(x, 3);
  }
  CHECK(differ > 90);
}

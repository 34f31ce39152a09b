#include "kernels/water/refraction/profile.h"

#include <catch2/catch.hpp>

using namespace ensonify::refraction;

TEST_CASE("between knots speed is linear, outside it is constant") {
  const SoundSpeedProfile profile({{5, 1500}, {15, 1520}, {25, 1510}});
  CHECK(profile.speed_mps(-3) == 1500);
  CHECK(profile.speed_mps(10) == Approx(1510));
  CHECK(profile.speed_mps(15) == 1520);
  CHECK(profile.speed_mps(20) == Approx(1515));
  CHECK(profile.speed_mps(99) == 1510);
  CHECK(profile.slowness_spm(10) == Approx(1 / 1510.0));
  CHECK(profile.gradient_per_s(0) == 0);
  CHECK(profile.gradient_per_s(5) == Approx(2));  // at a knot: the layer below
  CHECK(profile.gradient_per_s(20) == Approx(-1));
  CHECK(profile.gradient_per_s(25) == 0);
  CHECK(SoundSpeedProfile::uniform(1480).speed_mps(33) == 1480);
}

TEST_CASE("a thinned cast keeps what matters") {
  std::vector<Knot> knots;
  for (int i = 0; i <= 400; ++i) {  // 0.1 m apart: isothermal, then a ramp, with 0.02 m/s of jitter
    const double depth = 0.1 * i;
    knots.push_back({depth, 1500 - (depth > 20 ? 2 * (depth - 20) : 0) + (i % 2 ? 0.02 : 0)});
  }
  const SoundSpeedProfile cast(knots), thin = cast.thinned(0.05);
  CHECK(thin.knots().size() <= 6);
  for (const Knot& knot : knots) REQUIRE(std::abs(thin.speed_mps(knot.depth_m) - knot.speed_mps) <= 0.05 + 1e-9);
  CHECK(cast.thinned(0).knots().size() > 380);
  CHECK(SoundSpeedProfile::uniform(1500).thinned(1) == SoundSpeedProfile::uniform(1500));
  CHECK_THROWS_WITH(cast.thinned(-1), "the tolerance of a thinned profile must not be negative");
}

TEST_CASE("a profile that cannot be is refused, and the knot is named") {
  CHECK_THROWS_WITH(SoundSpeedProfile({}), "a sound speed profile needs at least one knot");
  CHECK_THROWS_WITH(SoundSpeedProfile({{0, 1500}, {5, 1490}, {5, 1480}}),
                    "sound speed profile, knot 3 (5.000000 m, 1480.000000 m/s): depths must rise from knot to knot");
  CHECK_THROWS_WITH(SoundSpeedProfile({{0, 1500}, {5, 340}}),
                    "sound speed profile, knot 2 (5.000000 m, 340.000000 m/s): the speed must lie in 1300..1700 m/s");
  CHECK_THROWS_WITH(SoundSpeedProfile({{std::nan(""), 1500}}), Catch::Contains("the depth is not finite"));
  CHECK_THROWS_WITH(SoundSpeedProfile({{0, std::nan("")}}), Catch::Contains("must lie in 1300..1700"));
}

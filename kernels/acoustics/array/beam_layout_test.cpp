#include "kernels/acoustics/array/beam_layout.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify::array;
constexpr double kDeg = std::numbers::pi / 180.0;

TEST_CASE("beams are symmetric and spaced as they say") {
  const auto angle = equiangular_beams_rad(-65 * kDeg, 65 * kDeg, 256);
  REQUIRE(angle.size() == 256);
  CHECK(angle.front() == -angle.back());
  CHECK(angle[1] - angle[0] == Approx(130 * kDeg / 255).epsilon(1e-4));
  const auto distance = equidistant_beams_rad(-65 * kDeg, 65 * kDeg, 256);
  CHECK(distance.back() == Approx(65 * kDeg));
  CHECK(std::tan(distance[2]) - std::tan(distance[1]) ==
        Approx(std::tan(distance[128]) - std::tan(distance[127])).epsilon(1e-4));
  CHECK(equiangular_beams_rad(-10 * kDeg, 70 * kDeg, 3)[1] == Approx(30 * kDeg));  // a swath to one side
}

TEST_CASE("high density spaces soundings equally, each from the beam that points nearest") {
  const HighDensity layout = high_density_beams(-65 * kDeg, 65 * kDeg, 256, 400);
  REQUIRE(layout.beam_rad.size() == 256);
  REQUIRE(layout.sounding_rad.size() == 400);
  REQUIRE(layout.beam_of_sounding.size() == 400);
  CHECK(std::is_sorted(layout.beam_of_sounding.begin(), layout.beam_of_sounding.end()));
  CHECK(layout.beam_of_sounding.front() == 0);
  CHECK(layout.beam_of_sounding.back() == 255);
  const double beam_step = 130 * kDeg / 255;
  for (std::size_t i = 0; i < 400; ++i) {
    const double sine = std::sin(layout.sounding_rad[i]);
    const auto distance = [&](float beam) { return std::abs(std::sin(beam) - sine); };
    const auto nearest = std::min_element(layout.beam_rad.begin(), layout.beam_rad.end(),
                                          [&](float a, float b) { return distance(a) < distance(b); });
    CHECK(layout.beam_of_sounding[i] == nearest - layout.beam_rad.begin());
    CHECK(std::abs(layout.sounding_rad[i] - *nearest) <= 0.51 * beam_step);  // nearest in sine, hence not 0.50
  }
  // The outermost beam is 0.51 deg wide in angle, a step of the seabed there 2 tan(65) / 399 cos^2(65) = 0.11 deg.
  CHECK(std::count(layout.beam_of_sounding.begin(), layout.beam_of_sounding.end(), 254) == 4);
}

TEST_CASE("a swath that cannot be is refused") {
  CHECK_THROWS_WITH(equiangular_beams_rad(0.5, -0.5, 8),
                    "a swath from 0.500000 to -0.500000 rad: allowed inside -pi/2 to pi/2, ascending");
  CHECK_THROWS_WITH(equidistant_beams_rad(-1.6, 1.0, 8),
                    "a swath from -1.600000 to 1.000000 rad: allowed inside -pi/2 to pi/2, ascending");
  CHECK_THROWS_WITH(equidistant_beams_rad(-1.0, 1.0, 1), "1 beams: at least 2");
  CHECK_THROWS_WITH(high_density_beams(-1.0, 1.0, 256, 100), "100 soundings of 256 beams: at least one per beam");
}

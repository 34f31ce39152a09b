#include <catch2/catch.hpp>
#include <utility>

#include "kernels/acoustics/echo/testing/flat_seabed.h"

// Mean levels against the closed forms of docs/physics/acoustics/echo.md, as sums of mean squares: no speckle, no
// draws.

using namespace ensonify;
using namespace ensonify::echo;
using Catch::WithinAbs;

TEST_CASE("the mean level of a sidescan on a Lambert seabed is that of the closed form") {
  const Image image = sidescan_mean_square(array::length_in_waves_for(0.5 * kDeg));
  const std::pair<double, double> anchors[] = {{20, 103.50}, {50, 77.06}, {100, 51.95}};
  for (const auto& [range_m, level_db] : anchors) {
    INFO("slant range " << range_m);
    CHECK_THAT(sidescan_level_db(image, range_m), WithinAbs(level_db, 0.15));
  }
}

TEST_CASE("the peak level of a multibeam on a Lambert seabed is that of the area integral") {
  // SL 220 dB, 100 us, 1 x 1 deg, 0.07 dB/m, 20 m above a -25 dB seabed. A pulse holds 10 rows of 24 rays and more: the
  // sum of one pulse scatters by some 2 %, and the peak over samples stands up to 0.1 dB above the mean.
  const auto arrivals = below_a_multibeam(24, 16384);
  const std::pair<double, double> anchors[] = {{0, 131.86}, {30, 124.20}, {45, 117.65}, {60, 107.68}};
  for (const auto& [beam_deg, level_db] : anchors) {
    INFO("beam " << beam_deg);
    CHECK_THAT(peak_db(arrivals, beam_deg * kDeg, 25e-6), WithinAbs(level_db, 0.15));
  }
}

TEST_CASE("the level depends neither on the number of rays nor on the sample rate") {
  const auto few = below_a_multibeam(24, 8192), many = below_a_multibeam(48, 16384);
  const double level = peak_db(few, 45 * kDeg, 25e-6);
  CHECK_THAT(peak_db(many, 45 * kDeg, 25e-6), WithinAbs(level, 0.2));
  CHECK_THAT(peak_db(few, 45 * kDeg, 12.5e-6), WithinAbs(level, 0.2));
}

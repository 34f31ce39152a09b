#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/survey/spacing.h"

using namespace ensonify::survey;

TEST_CASE("a towfish 10 m up sees from its gap to sqrt(R^2 - h^2)") {
  const auto swath = sidescan_swath(10.0, 100.0, std::atan(0.5));
  CHECK(swath.near_m == Approx(5.0));
  CHECK(swath.far_m == Approx(std::sqrt(9900.0)));
  CHECK(std::sin(swath.far_grazing_rad) == Approx(0.1));
  CHECK(towfish_altitude_m(100.0, 0.1, 5.0) == Approx(10.0));
  CHECK(towfish_altitude_m(100.0, 0.1, 15.0) == Approx(15.0));
}

TEST_CASE("lines that fill the gaps leave nothing unseen, lines a little farther apart do") {
  const auto swath = sidescan_swath(10.0, 100.0, 0.6);
  const double far_m = swath.far_m, near_m = swath.near_m;
  const auto unseen = [&](double spacing_m) {  // places between the middle two of many lines that no line sees
    int places = 0;
    for (double x = 0.0; x < spacing_m; x += 0.01) {
      bool seen = false;
      for (int line = -5; line <= 6; ++line) {
        const double off_m = std::abs(x - line * spacing_m);
        seen = seen || (off_m >= near_m && off_m <= far_m);
      }
      places += !seen;
    }
    return places;
  };
  CHECK(unseen(gap_filling_spacing_m(swath, 0.0)) == 0);
  CHECK(unseen(gap_filling_spacing_m(swath, 0.0) + 2.0 * near_m + 0.1) > 0);
  CHECK(unseen(joining_spacing_m(swath, 0.0)) > 0);
}

TEST_CASE("a shadow ends where the ray over the object hits the bottom") {
  // Similar triangles: altitude / (ground range + shadow) = object / shadow.
  const double shadow = shadow_m(1.0, 10.0, 45.0);
  CHECK(10.0 / (45.0 + shadow) == Approx(1.0 / shadow));
  CHECK(std::isinf(shadow_m(10.0, 10.0, 45.0)));
}

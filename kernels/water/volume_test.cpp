#include <catch2/catch.hpp>
#include <limits>
#include <vector>

#include "kernels/water/column.h"

using namespace ensonify::water;
using Catch::WithinAbs;

TEST_CASE("a depth has the strength of its layer, both where layers overlap, none between") {
  const std::vector<ScatteringLayer> layers{{0, 10, -70}, {5, 20, -70}, {30, 40, -55}};
  CHECK(volume_scattering_db(layers, 0) == Approx(-70));
  CHECK_THAT(volume_scattering_db(layers, 7), WithinAbs(-66.99, 0.005));  // two equals: + 3.01 dB
  CHECK(volume_scattering_db(layers, 12) == Approx(-70));
  CHECK(volume_scattering_db(layers, 39.99) == Approx(-55));
  for (const double empty : {-1.0, 20.0, 25.0, 40.0}) {
    CHECK(volume_scattering_db(layers, empty) == -std::numeric_limits<double>::infinity());
  }
}

TEST_CASE("layers that touch do not count twice where they touch") {
  const std::vector<ScatteringLayer> layers{{0, 10, -70}, {10, 20, -60}};
  CHECK(volume_scattering_db(layers, 10) == Approx(-60));
}

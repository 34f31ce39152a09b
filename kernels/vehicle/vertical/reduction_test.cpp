#include "kernels/vehicle/vertical/reduction.h"

#include <catch2/catch.hpp>

#include "kernels/vehicle/vertical/floating.h"

using namespace ensonify::vertical;
using ensonify::frames::Vec2;

TEST_CASE("GGA's height is that above the geoid, from which chart datum differs by place") {
  Datums datums;
  CHECK(geoid_height_m(datums, {1234, -2345, 7.5}) == 7.5);
  datums.datum_above_geoid = Separation(Vec2(0, 0), 1000, 2, 2, {-2.4, -2.2, -2.4, -2.2});
  CHECK(geoid_height_m(datums, {250, 400, 7.5}) == Approx(7.5 - 2.35));
}

TEST_CASE("pressure depth counts from the water's surface, whatever the datum") {
  CHECK(depth_below_water_m({10, 20, 1.2}, 3.0) == Approx(1.8));
}

TEST_CASE("settlement is the table's, flat beyond it, and grows with its slope") {
  const Loading loading{{{0, 0.0}, {2, 0.02}, {5, 0.11}}, 0.0, 0.0};
  CHECK(sinkage_m(loading, 2.0, 0.0) == Approx(0.02));
  CHECK(sinkage_m(loading, 3.5, 0.0) == Approx(0.065));
  CHECK(sinkage_m(loading, 9.0, 0.0) == Approx(0.11));
  CHECK(sinkage_m({{}, 0.05, -1e-6}, 3.0, 10000.0) == Approx(0.04));
}

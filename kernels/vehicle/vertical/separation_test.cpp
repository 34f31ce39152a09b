#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/vehicle/vertical/reduction.h"

using ensonify::frames::Vec2;
using ensonify::vertical::Separation;

TEST_CASE("a grid gives its posts, a plane between them, and its edge outside") {
  std::vector<double> plane;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) plane.push_back(5.0 + 0.1 * column - 0.2 * row);
  }
  const Separation grid({-100, 50}, 10.0, 4, 3, plane);
  CHECK(grid.at({-100, 50}) == Approx(5.0));
  CHECK(grid.at({-70, 70}) == Approx(5.0 + 0.3 - 0.4));
  CHECK(grid.at({-86, 63}) == Approx(5.0 + 0.14 - 0.26));
  CHECK(grid.at({-500, 50}) == Approx(5.0));
  CHECK(grid.at({500, 500}) == Approx(5.0 + 0.3 - 0.4));
  CHECK(Separation(-31.2).at({1, 2}) == -31.2);
}

TEST_CASE("a grid covers its cells, which reach half a spacing beyond their posts") {
  const Separation grid({-100, 50}, 10.0, 4, 3, std::vector<double>(12, 1.0));  // east -105 to -65, north 45 to 75
  for (const Vec2& inside : {Vec2(-104, 46), Vec2(-66, 46), Vec2(-104, 74), Vec2(-66, 74)}) CHECK(grid.covers(inside));
  for (const Vec2& outside : {Vec2(-106, 60), Vec2(-64, 60), Vec2(-80, 44), Vec2(-80, 76)}) {
    CHECK_FALSE(grid.covers(outside));
  }
  CHECK(Separation(3.0).covers({1e5, -1e5}));
}

TEST_CASE("a grid with a hole or without posts is refused") {
  CHECK_THROWS_AS(Separation(Vec2(0, 0), 10, 2, 2, {1, 2, 3}), std::invalid_argument);
  CHECK_THROWS_AS(Separation(Vec2(0, 0), 10, 2, 2, {1, 2, 3, NAN}), std::invalid_argument);
  CHECK_THROWS_AS(Separation(Vec2(0, 0), 0, 2, 2, {1, 2, 3, 4}), std::invalid_argument);
}

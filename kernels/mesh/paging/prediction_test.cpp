#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "kernels/mesh/paging/rules.h"

using namespace ensonify::paging;
using Catch::WithinAbs;

namespace {

const TileGrid kGrid{Vec2::Zero(), 0.1, 1000, 1e-4};  // tiles of 100 m
const Box kTerrain{{-1000, -1000}, {1000, 1000}};
constexpr double kInfinite = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("a straight track is place plus velocity times time") {
  const Vec2 place = place_after({{10, 20}, {3, -4}, 0.0}, 5.0);
  CHECK(place.x() == Approx(25.0));
  CHECK_THAT(place.y(), WithinAbs(0.0, 1e-12));
}

TEST_CASE("a turning track is a circle of radius speed over turn rate") {
  const Motion motion{{0, 0}, {4, 0}, 0.1};  // radius 40 m, centre at (0, 40): to the left of eastward
  const double quarter_s = 0.5 * 3.14159265358979 / 0.1;
  CHECK(place_after(motion, quarter_s).x() == Approx(40.0));
  CHECK(place_after(motion, quarter_s).y() == Approx(40.0));
  CHECK_THAT(place_after(motion, 4.0 * quarter_s).norm(), WithinAbs(0.0, 1e-9));
  for (double t = 0.0; t < 100.0; t += 1.7) CHECK((place_after(motion, t) - Vec2(0, 40)).norm() == Approx(40.0));
}

TEST_CASE("a turn that fades is the straight track") {
  // Over 10 s the chord of a turn of 1e-7 rad/s leaves the straight line by v t (w t) / 2 = 2e-5 m.
  const Vec2 turning = place_after({{0, 0}, {4, 0}, 1e-7}, 10.0), straight = place_after({{0, 0}, {4, 0}, 0.0}, 10.0);
  CHECK((turning - straight).norm() < 2.1e-5);
}

TEST_CASE("along a straight track a tile is due when it is as near as the margin") {
  // Eastward at 4 m/s from (50, 50), margin 60 m: the tile from x = 200 is at 60 m when the vehicle is at 140 m, after
  // 22.5 s; the next after 47.5 s; the one behind, 50 m away, is due now.
  const Motion east{{50, 50}, {4, 0}, 0.0};
  std::map<TileKey, double> due;
  for (const Need& need : needs(kGrid, kTerrain, east, {60.0, 0.5, 60.0, 60.0})) due[need.key] = need.due_s;
  CHECK(due.at({0, 0}) == 0.0);
  CHECK(due.at({-1, 0}) == 0.0);
  CHECK(due.at({2, 0}) == 22.5);
  CHECK(due.at({3, 0}) == 47.5);
  CHECK_FALSE(due.contains({4, 0}));  // after 72.5 s
}

TEST_CASE("what is due comes first and in its order, what is only near comes by distance") {
  const Motion east{{50, 50}, {4, 0}, 0.0};
  const auto all = needs(kGrid, kTerrain, east, {60.0, 0.5, 60.0, 170.0});
  for (std::size_t i = 1; i < all.size(); ++i) {
    CHECK(all[i - 1].due_s <= all[i].due_s);
    if (all[i - 1].due_s == all[i].due_s) CHECK(all[i - 1].distance_m <= all[i].distance_m);
  }
  CHECK(all.front().key == TileKey{0, 0});
  CHECK(all.back().due_s == kInfinite);
  CHECK(all.back().distance_m <= 170.0);
}

TEST_CASE("a vehicle at rest needs what is near it") {
  const Motion rest{{50, 50}, {0, 0}, 0.0};
  const auto all = needs(kGrid, kTerrain, rest, {600.0, 0.5, 60.0, 60.0});
  REQUIRE(all.size() == 5);
  for (const Need& need : all) CHECK(need.due_s == 0.0);
}

TEST_CASE("a circle needs the tiles around it however long it is followed") {
  const Motion circling{{50, 0}, {4, 0}, 4.0 / 30.0};  // radius 30 m around (50, 30); a turn takes 47 s
  const Horizon once{50.0, 0.5, 60.0, 60.0}, long_time{1000.0, 0.5, 60.0, 60.0};
  CHECK(needs(kGrid, kTerrain, circling, once).size() == needs(kGrid, kTerrain, circling, long_time).size());
}

TEST_CASE("an outlook that cannot be meant is refused") {
  CHECK_THROWS_AS(needs(kGrid, kTerrain, {}, {60.0, 0.0, 60.0, 60.0}), std::invalid_argument);
  CHECK_THROWS_AS(needs(kGrid, kTerrain, {}, {-1.0, 0.5, 60.0, 60.0}), std::invalid_argument);
  CHECK_THROWS_AS(needs(kGrid, kTerrain, {}, {60.0, 0.5, 60.0, 59.0}), std::invalid_argument);
}

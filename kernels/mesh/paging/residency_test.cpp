#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <stdexcept>

#include "kernels/mesh/paging/rules.h"

using namespace ensonify::paging;

namespace {

const TileGrid kGrid{Vec2::Zero(), 0.1, 1000, 1e-4};  // tiles of 100 m
const Box kTerrain{{-1000, -1000}, {1000, 1000}};

/// How many tiles heads are given or lose after the first of ten turns around a circle.
std::size_t exchanged_while_circling(const Vec2& centre, double radius_m, const Margins& margins) {
  std::set<TileKey> held;
  std::size_t exchanged = 0;
  for (double turn = 0.0; turn < 10.0; turn += 0.01) {
    const double angle = 2.0 * 3.14159265358979 * turn;
    const Vec2 place = centre + radius_m * Vec2(std::cos(angle), std::sin(angle));
    const std::vector<TileKey> now(held.begin(), held.end());
    const auto change = exchange(kGrid, kTerrain, place, margins, now);
    held.insert(change.give.begin(), change.give.end());
    for (const TileKey& key : change.take) held.erase(key);
    if (turn >= 1.0) exchanged += change.give.size() + change.take.size();
  }
  return exchanged;
}

}  // namespace

TEST_CASE("what is needed is held first, then what was wanted last") {
  const std::vector<TileKey> needed = {{5, 0}, {6, 0}};
  const LastWanted held = {{{1, 0}, 10}, {{2, 0}, 30}, {{3, 0}, 20}, {{4, 0}, 5}, {{5, 0}, 5}};
  CHECK(to_hold(needed, held, 100) == std::vector<TileKey>{{5, 0}, {6, 0}, {2, 0}, {3, 0}, {1, 0}, {4, 0}});
  CHECK(to_hold(needed, held, 4) == std::vector<TileKey>{{5, 0}, {6, 0}, {2, 0}, {3, 0}});
  CHECK(to_hold(needed, held, 1) == std::vector<TileKey>{{5, 0}});
}

TEST_CASE("tiles wanted at the same time are held in the order of their keys") {
  const LastWanted held = {{{2, 0}, 7}, {{1, 1}, 7}, {{1, 0}, 7}};
  CHECK(to_hold({}, held, 2) == std::vector<TileKey>{{1, 0}, {1, 1}});
}

TEST_CASE("between the margins heads keep what they hold and get nothing") {
  const Margins margins{60, 90};
  // At (50, 50): its own and the four beside it, 50 m away.
  const auto first = exchange(kGrid, kTerrain, {50, 50}, margins, {});
  REQUIRE(first.give.size() == 5);
  CHECK(first.give.front() == TileKey{0, 0});
  // At (145, 50) the column 100..200 is ahead, all of it held or given; the western column's edge is 145 m behind:
  // taken.
  const auto on = exchange(kGrid, kTerrain, {145, 50}, margins, first.give);
  CHECK(on.take == std::vector<TileKey>{{-1, 0}});
  // At (85, 50) the western column's edge is 85 m behind: not given, not taken.
  const auto between = exchange(kGrid, kTerrain, {85, 50}, margins, first.give);
  CHECK(between.take.empty());
  for (const TileKey& key : between.give) CHECK(key.east == 1);
}

TEST_CASE("along any track heads hold every tile within the margin, and none twice") {
  const Margins margins{60, 90};
  std::set<TileKey> held;
  for (double t = 0.0; t < 600.0; t += 0.5) {
    const Vec2 place(-500 + 1.7 * t, 200 * std::sin(t / 40));
    const std::vector<TileKey> now(held.begin(), held.end());
    const auto change = exchange(kGrid, kTerrain, place, margins, now);
    for (const TileKey& key : change.give) REQUIRE(held.insert(key).second);
    for (const TileKey& key : change.take) REQUIRE(held.erase(key) == 1);
    for (const TileKey& key : tiles_near(kGrid, kTerrain, place, margins.feed_m)) REQUIRE(held.contains(key));
  }
}

TEST_CASE("a vehicle that circles where tiles begin and end sends none to and fro") {
  // A circle of 14 m about (155, 150): tile (0, 1) ends at x = 100, 41 to 69 m away: on both sides of the feed margin
  // of 60 m and never beyond the release margin of 90 m. With one margin alone it goes to and fro in each of nine
  // turns.
  CHECK(exchanged_while_circling({155, 150}, 14.0, {60, 90}) == 0);
  CHECK(exchanged_while_circling({155, 150}, 14.0, {60, 60}) >= 2 * 9);
}

TEST_CASE("a release margin within the feed margin is refused") {
  CHECK_THROWS_AS(exchange(kGrid, kTerrain, {0, 0}, {60, 59}, {}), std::invalid_argument);
}

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "kernels/mesh/paging/rules.h"

using namespace ensonify::paging;

namespace {

const TileGrid kGrid{Vec2::Zero(), 0.1, 1000, 1e-4};  // tiles of 100 m
const Box kTerrain{{-1000, -1000}, {1000, 1000}};

}  // namespace

TEST_CASE("the distance of a box is that of its nearest side or corner, and nothing inside") {
  const Box box{{0, 0}, {100, 100}};
  CHECK(distance_m(box, {50, 50}) == 0.0);
  CHECK(distance_m(box, {100, 0}) == 0.0);
  CHECK(distance_m(box, {130, 50}) == 30.0);
  CHECK(distance_m(box, {-3, -4}) == 5.0);
}

TEST_CASE("tiles within the margin come nearest first and equally near ones by key") {
  // From (50, 30): its own tile, the southern at 30 m, west and east at 50 m, the southern corners at sqrt(50^2 + 30^2)
  // = 58.3 m; the northern at 70 m is beyond.
  const std::vector<TileKey> wanted = {{0, 0}, {0, -1}, {-1, 0}, {1, 0}, {-1, -1}, {1, -1}};
  CHECK(tiles_near(kGrid, kTerrain, {50, 30}, 60.0) == wanted);
  CHECK(tiles_near(kGrid, kTerrain, {50, 30}, 0.0) == std::vector<TileKey>{{0, 0}});
}

TEST_CASE("what lies beyond the terrain is no tile") {
  CHECK(tiles_near(kGrid, kTerrain, {5000, 0}, 60.0).empty());
  for (const TileKey& key : tiles_near(kGrid, kTerrain, {990, 990}, 500.0)) {
    CHECK(key.east <= 10);
    CHECK(key.north <= 10);
  }
}

TEST_CASE("nowhere are more tiles near than the most, and somewhere nearly as many") {
  CHECK(most_tiles_near(100.0, 0.0) == 4);  // at a corner, whose tiles share it
  std::mt19937 random(4);
  std::uniform_real_distribution<double> anywhere(0.0, 100.0);
  const Box endless{{-5000, -5000}, {5000, 5000}};
  for (const double margin_m : {10.0, 60.0, 140.0, 253.0, 400.0}) {
    const std::size_t most = most_tiles_near(100.0, margin_m);
    std::size_t found = 0;
    for (int i = 0; i < 2000; ++i) {
      found = std::max(found, tiles_near(kGrid, endless, {anywhere(random), anywhere(random)}, margin_m).size());
    }
    CHECK(found <= most);
    // Widening the margin by 100 m x sqrt(2) / 32 = 4.4 m adds no more than that times the perimeter of the touched
    // area, 2 pi (margin + 100 m), over the area of a tile, and what rows of tiles make of it: one row.
    const double more = 4.4 * 2.0 * 3.14159 * (margin_m + 100.0) / 1e4 + 2.0 * (margin_m / 100.0 + 1.0);
    CHECK(static_cast<double>(most - found) <= more);
  }
}

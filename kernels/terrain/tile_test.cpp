#include "kernels/terrain/tile.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

using namespace ensonify::terrain;

static Tile plane_tile() {  // z = -20 + 0.1 x - 0.2 y
  return sample_tile({.origin_enu_m = {-4, -4}, .spacing_m = 0.5, .cells = 16, .lsb_m = 1e-4}, {0, 0},
                     [](double x, double y) { return -20 + 0.1 * x - 0.2 * y; });
}

TEST_CASE("a plane is reproduced between its posts, with its normal") {
  const Tile tile = plane_tile();
  REQUIRE_FALSE(fault_of(tile));
  CHECK(*height_m(tile, {1.13, -2.71}) == Approx(-20 + 0.113 + 0.542).margin(1e-4));
  CHECK((*normal_enu(tile, {1.13, -2.71}) - Vec3(-0.1, 0.2, 1).normalized()).norm() < 1e-3);
  CHECK(*height_m(tile, {4, 4}) == Approx(-20.4).margin(1e-4));  // the far corner belongs to the tile
  CHECK_FALSE(height_m(tile, {4.001, 0}));
  CHECK_FALSE(height_m(tile, {std::nan(""), 0}));
}

TEST_CASE("a hole hides the four cells around it and no others") {
  Tile tile = plane_tile();
  tile.height_m[tile.post(4, 4)] = std::nanf("");
  CHECK_FALSE(height_m(tile, {-2.1, -2.1}));
  CHECK_FALSE(height_m(tile, {-1.6, -2.4}));
  CHECK(height_m(tile, {-1.4, -2.1}));
}

TEST_CASE("neighbours share their edge posts to the bit, far from the origin too") {
  const TileGrid grid{.origin_enu_m = {-1234.56, 7.7}, .spacing_m = 0.1, .cells = 64, .lsb_m = 1e-4};
  const auto height = [](double x, double y) { return -17 + std::sin(0.3 * x) * std::cos(0.2 * y); };
  const Tile a = sample_tile(grid, {-3, 5}, height), east = sample_tile(grid, {-2, 5}, height),
             north = sample_tile(grid, {-3, 6}, height);
  for (int i = 0; i <= 64; ++i) {
    REQUIRE(std::memcmp(&a.height_m[a.post(64, i)], &east.height_m[east.post(0, i)], 4) == 0);
    REQUIRE(std::memcmp(&a.height_m[a.post(i, 64)], &north.height_m[north.post(i, 0)], 4) == 0);
  }
  CHECK((east.origin_enu_m - a.origin_enu_m - Vec2(6.4, 0)).norm() < 1e-9);
  CHECK(grid.key_at(a.origin_enu_m + Vec2(0.05, 0.05)) == TileKey{-3, 5});
}

TEST_CASE("heights are whole steps of the lattice, and a hole stays one") {
  CHECK(on_lattice(-12.34567, 1e-3) == Approx(-12.346).margin(1e-6));
  CHECK(std::isnan(on_lattice(std::nan(""), 1e-3)));
}

TEST_CASE("the class is that of the nearest post") {
  Tile tile = plane_tile();
  CHECK(sediment_at(tile, {0, 0}) == 0);
  tile.sediment.assign(tile.height_m.size(), 1);
  tile.sediment[tile.post(8, 8)] = 2;
  CHECK(sediment_at(tile, {0.2, -0.2}) == 2);
  CHECK(sediment_at(tile, {0.3, 0}) == 1);
  CHECK(sediment_at(tile, {99, 0}) == 0);
}

TEST_CASE("a tile with wrong sizes is named as such") {
  Tile tile = plane_tile();
  tile.height_m.pop_back();
  CHECK(fault_of(tile) == std::string("the number of heights is not columns x rows"));
}

#include "kernels/mesh/tile.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <utility>

#include "kernels/base/random/stream.h"

using namespace ensonify::terrain;
using Catch::Matchers::WithinAbs;

static Tile plane_tile() {  // z = -20 + 0.1 x - 0.2 y
  return sample_tile({.origin_enu_m = {-4, -4}, .spacing_m = 0.5, .cells = 16, .lsb_m = 1e-4}, {0, 0},
                     [](double x, double y) { return -20 + 0.1 * x - 0.2 * y; });
}

TEST_CASE("a plane is reproduced between its posts, with its normal") {
  const Tile tile = plane_tile();
  REQUIRE_FALSE(fault_of(tile));
  CHECK_THAT(*height_m(tile, {1.13, -2.71}), WithinAbs(-20 + 0.113 + 0.542, 1e-4));
  CHECK((*normal_enu(tile, {1.13, -2.71}) - Vec3(-0.1, 0.2, 1).normalized()).norm() < 1e-3);
  CHECK_THAT(*height_m(tile, {4, 4}), WithinAbs(-20.4, 1e-4));  // the far corner belongs to the tile
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
  CHECK_THAT(on_lattice(-12.34567, 1e-3), WithinAbs(-12.346, 1e-6));
  CHECK(std::isnan(on_lattice(std::nan(""), 1e-3)));
}

TEST_CASE("the class is that of the nearest post") {
  Tile tile = plane_tile();
  CHECK(sediment_at(tile, {0, 0}) == 0);
  tile.everywhere = 3;
  CHECK(sediment_at(tile, {0, 0}) == 3);
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

TEST_CASE("steps of height are a dither where posts differ by half a step or more") {
  // Errors of rounding where neighbours differ by s steps rms: uniform, and correlated by 6/pi^2 sum exp(-2 pi^2 k^2
  // s^2)/k^2 [Widrow2008]: 0.178 for s = 0.25, 0.0044 for 0.5, 0 for 1. Of 200,000 posts: 0.0022 sd, and 0.2 % for the
  // variance.
  const ensonify::random::Stream draw{1, "dither"};
  for (const auto& [s, correlation] : {std::pair{0.25, 0.178}, {0.5, 0.0044}, {1.0, 0.0}}) {
    constexpr int kPosts = 200000;
    constexpr double kStep = 0.5;  // so that the lattice itself is exact in float
    double steps = 0.3, before = 0.0, squares = 0.0, products = 0.0;
    for (int n = 0; n < kPosts; ++n) {
      steps += s * draw.normal(static_cast<std::uint64_t>(n));
      const double error = static_cast<double>(on_lattice(steps * kStep, kStep)) / kStep - steps;
      squares += error * error;
      products += error * before;
      before = error;
    }
    CHECK(squares / kPosts == Approx(1.0 / 12.0).epsilon(0.01));
    CHECK_THAT(products / squares, WithinAbs(correlation, 0.01));
  }
}

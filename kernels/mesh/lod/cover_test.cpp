#include "kernels/mesh/lod/cover.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

using namespace ensonify;
using namespace ensonify::lod;

namespace {

terrain::Tile flat(int columns, int rows) {
  return {{0, 0}, 0.5, columns, rows, std::vector<float>(std::size_t(columns) * std::size_t(rows), -20.0F), {}};
}

/// A fan straight down at (x, 40), narrow to the north, 20 m to either side.
View fan_at(double x, int level) {
  View view;
  view.level = level;
  view.frustum.apex_enu_m = {x, 40, 0};
  view.frustum.axis_enu = frames::Vec3::UnitY();
  view.frustum.side_enu = frames::Vec3::UnitX();
  view.frustum.zero_enu = -frames::Vec3::UnitZ();
  view.frustum.low_sine = -0.02;
  view.frustum.high_sine = 0.02;
  view.frustum.low_angle_rad = -std::numbers::pi / 4;
  view.frustum.high_angle_rad = std::numbers::pi / 4;
  view.frustum.max_range_m = 100;
  return view;
}

}  // namespace

TEST_CASE("blocks cover a tile once, as finely as the views ask for") {
  const terrain::Tile tile = flat(1025, 713);
  const Hierarchy hierarchy(tile);
  Cover cover;
  const std::vector<View> views{fan_at(100, 0), fan_at(300, 2)};
  cover.choose(hierarchy, views);
  std::vector<int> covered(std::size_t(1024 * 712), 0);
  std::set<int> levels;
  std::size_t small_and_coarse = 0;
  for (const Leaf& leaf : cover.leaves()) {
    const Posts under = hierarchy.posts(leaf.block);
    levels.insert(leaf.level);
    small_and_coarse += leaf.block.size == 1 && leaf.level == 4 ? 1U : 0U;
    for (int y = under.south; y < under.north; ++y) {
      for (int x = under.west; x < under.east; ++x) ++covered[std::size_t(y) * 1024 + std::size_t(x)];
    }
    for (const View& view : views) {
      if (intersects(view.frustum, hierarchy.sphere(leaf.block))) REQUIRE(leaf.level <= view.level);
    }
  }
  CHECK(std::ranges::all_of(covered, [](int times) { return times == 1; }));
  CHECK(levels.contains(0));
  CHECK(levels.contains(2));
  CHECK(*levels.rbegin() > 2);
  CHECK(small_and_coarse > 0);          // beside what is examined, as coarse as there is room
  CHECK(cover.level_over(6, 2) == 0);   // (100, 40) m
  CHECK(cover.level_over(18, 2) == 2);  // (300, 40) m
  CHECK(cover.level_over(32, 0) == Cover::kNone);
}

TEST_CASE("without a view all is as coarse as it can be") {
  Cover cover;
  cover.choose(Hierarchy(flat(1025, 1025)), {});
  REQUIRE(cover.leaves().size() == 1);
  CHECK(cover.leaves()[0] == Leaf{{kLargest, 0, 0}, kCoarsest});
  cover.choose(Hierarchy(flat(60, 60)), {});  // 59 cells: less than three of 32, more than three of 16
  REQUIRE(cover.leaves().size() == 1);
  CHECK(cover.leaves()[0] == Leaf{{4, 0, 0}, 4});
}

TEST_CASE("all at full detail is the largest blocks, save those of holes") {
  terrain::Tile tile = flat(2049, 1025);
  Cover cover;
  cover.choose_all(Hierarchy(tile));
  CHECK(cover.leaves() == std::vector<Leaf>{{{kLargest, 0, 0}, 0}, {{kLargest, 1, 0}, 0}});
  CHECK(cover.level_over(63, 31) == 0);
  for (int row = 0; row < 1025; ++row) std::fill_n(&tile.height_m[tile.post(0, row)], 1025, std::nanf(""));
  cover.choose_all(Hierarchy(tile));
  CHECK(cover.leaves() == std::vector<Leaf>{{{kLargest, 1, 0}, 0}});
  CHECK(cover.level_over(31, 0) == Cover::kNone);
}

TEST_CASE("a rim has all posts except between two coarsest leaves, in its tile and the next") {
  const Hierarchy hierarchy(flat(257, 257));  // 8 x 8 blocks
  Cover fine, coarse;
  fine.choose(hierarchy, std::vector{fan_at(64, 0)});
  coarse.choose(hierarchy, {});
  REQUIRE(fine.level_over(4, 2) == 0);
  const Leaf root{{kLargest, 0, 0}, kCoarsest};
  Neighbours neighbours;
  neighbours.west = &fine;
  const Rim rim = rim_of(root, coarse, neighbours);
  std::uint32_t finer = 0;
  for (std::int32_t row = 0; row < 8; ++row) finer |= fine.level_over(7, row) < kCoarsest ? 1U << row : 0U;
  CHECK(finer != 0);
  CHECK(rim[kWest] == finer);
  CHECK(rim[kEast] == 0);
  CHECK(rim[kSouth] == 0);
  for (const Leaf& leaf : fine.leaves()) {
    if (leaf.level == kCoarsest) continue;
    const std::uint32_t whole = (1U << (1U << leaf.block.size)) - 1U;
    CHECK(rim_of(leaf, fine, {}) == Rim{whole, whole, whole, whole});
  }
}

TEST_CASE("50 m above posts of 0.1 m a swath's mesh is under 1/50 of the paged tiles") {
  // One tile's relief, repeated over the 21 tiles that a pager holds within 170 m (three depths and 20 m).
  constexpr double kSide_m = 102.4;
  const double turn = 2.0 * std::numbers::pi / kSide_m;
  terrain::Tile tile = terrain::sample_tile({.spacing_m = 0.1}, {0, 0}, [&](double x, double y) {
    return -50.0 + std::sin(2 * turn * x) * std::cos(3 * turn * y) +
           0.1 * std::sin(150 * turn * x) * std::sin(90 * turn * y);
  });
  std::map<terrain::TileKey, Hierarchy> hierarchies;
  for (int east = -2; east <= 2; ++east) {
    for (int north = -2; north <= 2; ++north) {
      if (std::abs(east) == 2 && std::abs(north) == 2) continue;  // more than 170 m away
      tile.origin_enu_m = {kSide_m * (east - 0.5), kSide_m * (north - 0.5)};
      hierarchies.emplace(terrain::TileKey{east, north}, Hierarchy(tile));
    }
  }
  REQUIRE(hierarchies.size() == 21);
  for (const double heading : {0.0, 0.5, 0.785}) {
    // A transmitter 50 wavelengths long: main lobe null to null, and all rays, eight times as far, at every fourth
    // post.
    View main;
    main.frustum.axis_enu = {std::sin(heading), std::cos(heading), 0.0};
    main.frustum.side_enu = {std::cos(heading), -std::sin(heading), 0.0};
    main.frustum.zero_enu = -frames::Vec3::UnitZ();
    main.frustum.low_sine = -0.02;
    main.frustum.high_sine = 0.02;
    main.frustum.low_angle_rad = -1.13;
    main.frustum.high_angle_rad = 1.13;
    main.frustum.max_range_m = 130.0;
    View all = main;
    all.level = 2;
    all.frustum.low_sine = -0.16;
    all.frustum.high_sine = 0.16;
    std::map<terrain::TileKey, Cover> covers;
    for (const auto& [key, hierarchy] : hierarchies) covers[key].choose(hierarchy, std::array{main, all});
    std::size_t triangles = 0;
    for (const auto& [key, hierarchy] : hierarchies) {
      const auto beside = [&, at = key](int east, int north) {
        const auto other = covers.find({at.east + east, at.north + north});
        return other == covers.end() ? nullptr : &other->second;
      };
      const Neighbours around{beside(-1, 0), beside(1, 0), beside(0, -1), beside(0, 1)};
      for (const Leaf& leaf : covers[key].leaves()) {
        triangles += patch_of(tile, hierarchy, leaf, rim_of(leaf, covers[key], around), {0, 0}).triangles();
      }
    }
    CAPTURE(heading, triangles);
    CHECK(triangles > 100'000);  // the main lobe's footprint alone: 214 m x 2 m and more
    CHECK(50 * triangles < 21UL * 2 * 1024 * 1024);
  }
}

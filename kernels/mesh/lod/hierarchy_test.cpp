#include "kernels/mesh/lod/hierarchy.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/base/random/stream.h"

using namespace ensonify;
using namespace ensonify::lod;

/// 201 x 329 posts of noise, with four blocks of holes and a few single ones.
static terrain::Tile rough_tile() {
  const random::Stream noise(1, "posts");
  terrain::Tile tile{{-7.0, 3.0}, 0.25, 201, 329, {}, {}};
  for (std::uint64_t i = 0; i < 201 * 329; ++i) tile.height_m.push_back(static_cast<float>(-20 + noise.normal(i)));
  for (int row = 64; row <= 128; ++row) {
    for (int column = 0; column <= 64; ++column) tile.height_m[tile.post(column, row)] = std::nanf("");
  }
  tile.height_m[tile.post(150, 200)] = std::nanf("");
  return tile;
}

TEST_CASE("blocks of every size cover the posts, and their spheres hold them") {
  const terrain::Tile tile = rough_tile();
  const Hierarchy hierarchy(tile);
  CHECK(hierarchy.columns(0) == 7);
  CHECK(hierarchy.rows(0) == 11);
  CHECK(hierarchy.columns(2) == 2);
  CHECK(hierarchy.rows(2) == 3);
  for (int size = 0; size <= kLargest; ++size) {
    std::size_t inside = 0, posts = 0;
    for (int row = 0; row < hierarchy.rows(size); ++row) {
      for (int column = 0; column < hierarchy.columns(size); ++column) {
        const Block block{size, column, row};
        const Posts under = hierarchy.posts(block);
        for (int y = under.south; y <= under.north; ++y) {
          for (int x = under.west; x <= under.east; ++x) {
            const terrain::Vec3 post = tile.position_enu_m(x, y);
            if (!std::isfinite(post.z())) continue;
            ++posts;
            const Sphere sphere = hierarchy.sphere(block);
            inside += (post - sphere.centre_enu_m).norm() <= sphere.radius_m ? 1U : 0U;
          }
        }
      }
    }
    CHECK(inside == posts);
  }
  // No larger than half the diagonal of 8 m x 8 m and of noise within 5 standard deviations, and the slack.
  CHECK(hierarchy.sphere({0, 1, 0}).radius_m < std::hypot(4.0, 4.0, 5.0) + 0.02);
}

TEST_CASE("a block of holes is empty, and one post makes it not so") {
  terrain::Tile tile = rough_tile();
  // The holes reach to the block's edge posts, which the neighbours have too.
  CHECK(Hierarchy(tile).empty({1, 0, 1}));
  CHECK_FALSE(Hierarchy(tile).empty({2, 0, 0}));
  tile.height_m[tile.post(30, 100)] = -3.0F;
  const Hierarchy hierarchy(tile);
  CHECK_FALSE(hierarchy.empty({0, 0, 3}));
  CHECK(hierarchy.sphere({0, 0, 3}).centre_enu_m.z() == -3.0);
}

TEST_CASE("a block shown by fewer than three cells has no room for a rim") {
  const Hierarchy hierarchy(rough_tile());          // 200 x 328 cells
  CHECK(hierarchy.has_room({{5, 0, 0}, 5}));        // 7 x 11 cells of 32
  CHECK(hierarchy.has_room({{1, 3, 5}, 1}));        // the last block: 4 x 4 cells of 2
  CHECK(hierarchy.has_room({{0, 0, 0}, 3}));        // 4 x 4 cells of 8
  CHECK_FALSE(hierarchy.has_room({{0, 0, 0}, 4}));  // 2 x 2 cells of 16
  CHECK_FALSE(Hierarchy({{0, 0}, 1.0, 130, 300, std::vector<float>(130 * 300, 0.0F), {}}).has_room({{1, 2, 0}, 1}));
}

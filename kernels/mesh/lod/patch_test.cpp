#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "kernels/base/random/stream.h"
#include "kernels/mesh/lod/cover.h"

using namespace ensonify;
using namespace ensonify::lod;

namespace {

using Place = std::array<float, 3>;
using Triangle = std::array<Place, 3>;

std::vector<Triangle> triangles_of(const Patch& patch) {
  std::vector<Triangle> all;
  const auto place = [&](std::size_t i) {
    const auto& v = patch.vertices_m[i];
    return Place{v.x(), v.y(), v.z()};
  };
  for (const Patch::Grid& grid : patch.grids) {
    for (std::size_t row = 0; row + 1 < grid.rows; ++row) {
      for (std::size_t column = 0; column + 1 < grid.columns; ++column) {
        const std::size_t corner = grid.first + row * grid.stride + column;
        const Place sw = place(corner), se = place(corner + 1), nw = place(corner + grid.stride),
                    ne = place(corner + grid.stride + 1);
        all.push_back({sw, se, nw});
        all.push_back({ne, nw, se});
      }
    }
  }
  return all;
}

/// Examines a small cone from a place 20 m above.
View spot(double x, double y, double half_rad, int level) {
  View view;
  view.level = level;
  view.frustum.apex_enu_m = {x, y, 0};
  view.frustum.axis_enu = frames::Vec3::UnitX();
  view.frustum.side_enu = frames::Vec3::UnitY();
  view.frustum.zero_enu = -frames::Vec3::UnitZ();
  view.frustum.low_sine = -half_rad;
  view.frustum.high_sine = half_rad;
  view.frustum.low_angle_rad = -half_rad;
  view.frustum.high_angle_rad = half_rad;
  view.frustum.max_range_m = 1000;
  return view;
}

/// Nine tiles of 200 x 200 cells, which is no whole number of blocks.
constexpr int kCells = 200;
const terrain::TileGrid kGrid{.origin_enu_m = {0, 0}, .spacing_m = 0.25, .cells = kCells};

struct Sea {
  std::map<terrain::TileKey, terrain::Tile> tiles;
  std::map<terrain::TileKey, Hierarchy> hierarchies;
  std::map<terrain::TileKey, Cover> covers;

  Sea() {
    for (int east : {0, 1, 2}) {
      for (int north : {0, 1, 2}) {
        const terrain::TileKey key{east, north};
        tiles[key] = terrain::sample_tile(
            kGrid, key, [](double x, double y) { return -20 + std::sin(3 * x) * std::cos(2 * y) + 0.1 * x; });
        hierarchies.emplace(key, Hierarchy(tiles[key]));
      }
    }
  }
  std::vector<Triangle> triangles(std::span<const View> views) {
    for (auto& [key, hierarchy] : hierarchies) covers[key].choose(hierarchy, views);
    std::vector<Triangle> all;
    for (const auto& [key, tile] : tiles) {
      const auto beside = [&, at = key](int east, int north) {
        const auto other = covers.find({at.east + east, at.north + north});
        return other == covers.end() ? nullptr : &other->second;
      };
      const Neighbours around{beside(-1, 0), beside(1, 0), beside(0, -1), beside(0, 1)};
      for (const Leaf& leaf : covers[key].leaves()) {
        const Patch patch = patch_of(tile, hierarchies.at(key), leaf, rim_of(leaf, covers[key], around), {0, 0});
        const auto some = triangles_of(patch);
        REQUIRE(some.size() == patch.triangles());
        all.insert(all.end(), some.begin(), some.end());
      }
    }
    return all;
  }
};

double plan_area_m2(const Triangle& t) {
  const auto d = [&](int i, int axis) {
    return double(t[std::size_t(i)][std::size_t(axis)] - t[0][std::size_t(axis)]);
  };
  return 0.5 * (d(1, 0) * d(2, 1) - d(1, 1) * d(2, 0));
}

}  // namespace

TEST_CASE("at any levels every triangle edge is shared, except at the end of the world") {
  Sea sea;
  const random::Stream draws(3, "spots");
  for (std::uint64_t trial = 0; trial < 12; ++trial) {
    std::vector<View> views;
    for (std::uint64_t i = 0; i < 4; ++i) {
      views.push_back(spot(150 * draws.uniform(trial, i, 0), 150 * draws.uniform(trial, i, 1),
                           0.02 + 0.3 * draws.uniform(trial, i, 2), static_cast<int>(5 * draws.uniform(trial, i, 3))));
    }
    const auto triangles = sea.triangles(views);
    double area_m2 = 0, folded_m2 = 0;
    std::map<std::pair<Place, Place>, int> edges;  // passages, counted backwards where they go to the lesser place
    for (const Triangle& t : triangles) {
      const double plan = plan_area_m2(t);
      area_m2 += plan;
      folded_m2 += std::min(0.0, plan);
      for (std::size_t i = 0; i < 3; ++i) {
        const Place &a = t[i], &b = t[(i + 1) % 3];
        if (a < b) ++edges[{a, b}];
        if (b < a) --edges[{b, a}];
      }
    }
    std::size_t open = 0, beyond = 0;
    for (const auto& counted : edges) {
      const auto& edge = counted.first;  // no structured binding: clang before 16 captures none
      const auto passages = counted.second;
      if (passages == 0) continue;
      const auto at_end = [&](std::size_t axis) {
        const float end = 3 * kCells * 0.25F;
        return edge.first[axis] == edge.second[axis] && (edge.first[axis] == 0 || edge.first[axis] == end);
      };
      (std::abs(passages) == 1 && (at_end(0) || at_end(1)) ? beyond : open) += 1;
    }
    CHECK(open == 0);
    CHECK(beyond > 0);
    CHECK(area_m2 == Approx(150.0 * 150.0).epsilon(1e-9));
    CHECK(folded_m2 == 0.0);
    CHECK(triangles.size() < 2 * 9 * kCells * kCells);
  }
}

TEST_CASE("a block of level 0 is the tile's posts") {
  Sea sea;
  const terrain::TileKey key{1, 1};
  const Patch patch = patch_of(sea.tiles[key], sea.hierarchies.at(key), {{0, 6, 1}, 0}, {}, {10, 20});
  REQUIRE(patch.grids.size() == 1);
  CHECK(patch.grids[0].columns == 9);  // the last 8 cells of 200
  CHECK(patch.grids[0].rows == 33);
  const terrain::Vec3 post = sea.tiles[key].position_enu_m(195, 34);
  const auto vertex = patch.vertices_m[2 * 9 + 3];
  CHECK(vertex.x() == static_cast<float>(post.x() - 10));
  CHECK(vertex.y() == static_cast<float>(post.y() - 20));
  CHECK(vertex.z() == static_cast<float>(post.z()));
}

TEST_CASE("no cell has a hole at a corner") {
  Sea sea;
  const terrain::TileKey key{0, 0};
  terrain::Tile& tile = sea.tiles[key];
  tile.height_m[tile.post(20, 30)] = std::nanf("");
  const Patch fine = patch_of(tile, Hierarchy(tile), {{0, 0, 0}, 0}, {}, {0, 0});
  CHECK(fine.triangles() == 2 * (32 * 32 - 4));
  const Patch coarse = patch_of(tile, Hierarchy(tile), {{1, 0, 0}, 1}, {3, 3, 3, 3}, {0, 0});
  CHECK(coarse.triangles() == 2 * (30 * 30 - 4 + 4 * 64));  // and 64 cells along each side
  for (const Triangle& t : triangles_of(fine)) {
    for (const Place& place : t) REQUIRE(std::isfinite(place[2]));
  }
}

TEST_CASE("a hole in a coarse block's rim removes only the cells at that corner") {
  Sea sea;
  terrain::Tile& tile = sea.tiles[{0, 0}];
  tile.height_m[tile.post(16, 0)] = std::nanf("");
  const Patch patch = patch_of(tile, Hierarchy(tile), {{0, 0, 0}, 2}, {1, 1, 1, 1}, {0, 0});
  double area_m2 = 0.0;
  for (const Triangle& t : triangles_of(patch)) {
    for (const Place& place : t) REQUIRE(std::isfinite(place[2]));
    area_m2 += plan_area_m2(t);
  }
  // Posts 0.25 m apart, the inner edge 1 m inside: a cell from posts 15 and 16 to 12 and 16, a triangle from 16 and 17
  // to 16.
  CHECK(area_m2 == Approx(8.0 * 8.0 - 0.5 * (0.25 + 1.0) - 0.5 * 0.25).epsilon(1e-9));
}

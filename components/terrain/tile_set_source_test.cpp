#include "components/terrain/tile_set_source.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "components/terrain/tiles/overview.h"
#include "components/terrain/tiles/tile_set.h"

using namespace ensonify;
using namespace ensonify::source;
using Catch::WithinAbs;
using terrain::TileKey;

namespace {

double seabed(double x, double y) { return -20.0 + 0.8 * std::sin(0.31 * x) + 0.05 * y; }
std::uint8_t kind(double x, double) { return x < 5.0 ? 1 : 2; }

/// Three tiles in an L: the north-east one is missing.
struct Set {
  std::string folder =
      (std::filesystem::temp_directory_path() / ("ensonify-tile-source-" + std::to_string(::getpid()))).string();
  tiles::TileSet set;
  Set() {
    set.folder = folder;
    set.origin = {42.25, -70.7};
    set.grid = {.spacing_m = 0.5, .cells = 32, .lsb_m = 2e-4};
    set.made_from = "a test";
    for (const TileKey key : {TileKey{-1, -1}, {-1, 0}, {0, -1}})
      set.tiles[key] = tiles::write_tile(set, key, terrain::sample_tile(set.grid, key, seabed, kind));
    tiles::write_manifest(set);
  }
  ~Set() { std::filesystem::remove_all(folder); }
};

}  // namespace

TEST_CASE("posts of a set are the stored ones, across tiles and beside a missing tile") {
  const Set made;
  const TileSetSource source(made.folder);
  CHECK(source.native_spacing_m() == 0.5);
  CHECK(source.extent().west_m == -16.0);
  CHECK(source.extent().north_m == 16.0);
  const PostBlock block{-40, -40, 80, 80, 0.5};
  std::vector<float> height(block.size());
  std::vector<std::uint8_t> sediment(block.size());
  source.sample(block, height, sediment);
  std::size_t k = 0;
  for (int row = 0; row < 80; ++row) {
    for (int column = 0; column < 80; ++column, ++k) {
      const auto east = block.first_east + column, north = block.first_north + row;
      const bool inside = east >= -32 && east <= 32 && north >= -32 && north <= 32 && (east <= 0 || north <= 0);
      INFO(east << ' ' << north);
      REQUIRE(std::isfinite(height[k]) == inside);
      if (!inside) continue;
      const double x = block.east_m(column), y = block.north_m(row);
      REQUIRE(height[k] == terrain::on_lattice(seabed(x, y), 2e-4));
      REQUIRE(sediment[k] == kind(x, y));
    }
  }
}

TEST_CASE("between posts a set is bilinear") {
  const Set made;
  const TileSetSource source(made.folder);
  // The curvature of the sine is 0.8 x 0.31^2: bilinear between posts 0.5 m apart is within 1/8 of that x 0.25.
  CHECK_THAT(source.height_m({-3.3, 7.7}), WithinAbs(seabed(-3.3, 7.7), 0.0025));
  CHECK(std::isnan(source.height_m({3.3, 7.7})));
  const PostBlock coarse{-4, -4, 8, 8, 3.7};
  std::vector<float> height(coarse.size());
  std::vector<std::uint8_t> sediment(coarse.size());
  source.sample(coarse, height, sediment);
  CHECK_THAT(height[0], WithinAbs(seabed(-14.8, -14.8), 0.0025));
  CHECK(sediment[0] == 1);
}

TEST_CASE("a set's overview is bit-equal to its posts, whether stored, missing or damaged") {
  Set made;
  const Overview from_tiles = TileSetSource(made.set).overview();
  CHECK(from_tiles.fault.empty());
  REQUIRE(from_tiles.posts.size() == 255U * 255U);
  const auto same = [&](const Overview& other) {
    return other.posts.size() == from_tiles.posts.size() && other.posts.first_east == from_tiles.posts.first_east &&
           std::memcmp(other.height_m.data(), from_tiles.height_m.data(), 255 * 255 * sizeof(float)) == 0;
  };
  std::size_t k = 0, holes = 0;
  for (int row = 0; row < 255; ++row) {
    for (int column = 0; column < 255; ++column, ++k) {
      const Vec2 place(from_tiles.posts.east_m(column), from_tiles.posts.north_m(row));
      if (std::isnan(from_tiles.height_m[k])) ++holes;
      else REQUIRE_THAT(from_tiles.height_m[k], WithinAbs(seabed(place.x(), place.y()), 0.0025));
    }
  }
  CHECK(holes == 128U * 128U);  // the missing tile's

  tiles::write_overview(made.set, {255, 255, from_tiles.height_m});
  tiles::write_manifest(made.set);
  for (const TileKey key : {TileKey{-1, -1}, {-1, 0}, {0, -1}})  // no tile is read for it
    std::filesystem::rename(made.set.path_of(key, ".png"), made.set.path_of(key, ".away"));
  const Overview kept = TileSetSource(made.folder).overview();
  CHECK(kept.fault.empty());
  CHECK(same(kept));
  for (const TileKey key : {TileKey{-1, -1}, {-1, 0}, {0, -1}})
    std::filesystem::rename(made.set.path_of(key, ".away"), made.set.path_of(key, ".png"));

  std::filesystem::resize_file(made.folder + "/" + tiles::kOverview, 1000);
  const Overview anew = TileSetSource(made.folder).overview();
  CHECK(anew.fault == made.folder + "/overview.npy: is no overview as this program writes them");
  CHECK(same(anew));

  tiles::write_overview(made.set, {2, 2, {0, 0, 0, 0}});
  CHECK(TileSetSource(made.set).overview().fault == made.folder + "/overview.npy: is not of 255 x 255 posts");
}

TEST_CASE("a whole tile has the bits that its posts have in a block that is none") {
  const Set made;
  const TileSetSource source(made.folder);
  const PostBlock whole{-32, 0, 33, 33, 0.5}, wider{-32, 0, 34, 33, 0.5};
  std::vector<float> height(whole.size()), wider_height(wider.size());
  std::vector<std::uint8_t> sediment(whole.size()), wider_sediment(wider.size());
  source.sample(whole, height, sediment);
  source.sample(wider, wider_height, wider_sediment);
  for (std::size_t row = 0; row < 33; ++row) {
    for (std::size_t column = 0; column < 33; ++column) {
      REQUIRE(height[row * 33 + column] == wider_height[row * 34 + column]);
      REQUIRE(sediment[row * 33 + column] == wider_sediment[row * 34 + column]);
    }
  }
}

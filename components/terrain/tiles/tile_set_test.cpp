#include "components/terrain/tiles/tile_set.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "components/config/config_error.h"
#include "components/terrain/tiles/faults.h"
#include "components/terrain/tiles/overview.h"

using namespace ensonify;
using namespace ensonify::tiles;
using Catch::Matchers::Contains;
using terrain::TileKey;

namespace {

/// An empty folder that goes with its owner.
struct Folder {
  std::string path =
      (std::filesystem::temp_directory_path() / ("ensonify-tiles-" + std::to_string(::getpid()))).string();
  Folder() { std::filesystem::remove_all(path); }
  ~Folder() { std::filesystem::remove_all(path); }
};

double seabed(double x, double y) { return -20.0 + 0.8 * std::sin(0.31 * x) + 0.05 * y; }
std::uint8_t kind(double x, double) { return x < 5.0 ? 1 : 2; }

TileSet empty_set(const std::string& folder) {
  TileSet set;
  set.folder = folder;
  set.origin = {42.25, -70.7};
  set.grid = {.spacing_m = 0.5, .cells = 32, .lsb_m = 2e-4};
  set.made_from = "a test";
  return set;
}

/// Two by two tiles around the world's origin, one with a hole.
TileSet written(const std::string& folder) {
  TileSet set = empty_set(folder);
  for (const TileKey key : {TileKey{-1, -1}, {-1, 0}, {0, -1}, {0, 0}}) {
    auto tile = terrain::sample_tile(set.grid, key, seabed, kind);
    if (key == TileKey{0, 0}) tile.height_m[tile.post(7, 9)] = std::nanf("");
    set.tiles[key] = write_tile(set, key, tile);
  }
  write_manifest(set);
  return set;
}

void flip(const std::string& path, std::streamoff from_end) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(-from_end, std::ios::end);
  const auto byte = static_cast<char>(file.get() ^ 1);
  file.seekp(-from_end, std::ios::end);
  file.put(byte);
}

}  // namespace

TEST_CASE("a set comes back from disk to the bit, holes and classes included") {
  const Folder folder;
  const TileSet set = written(folder.path), back = open_tile_set(folder.path);
  CHECK(back.tiles == set.tiles);
  CHECK(back.origin.latitude_deg == 42.25);
  CHECK(back.grid.lsb_m == 2e-4);
  for (const auto& [key, facts] : back.tiles) {
    const auto wanted = terrain::sample_tile(set.grid, key, seabed, kind), tile = read_tile(back, key);
    CHECK(tile.origin_enu_m == wanted.origin_enu_m);
    CHECK(tile.sediment == wanted.sediment);
    for (std::size_t post = 0; post < tile.height_m.size(); ++post) {
      if (key == TileKey{0, 0} && post == tile.post(7, 9)) CHECK(std::isnan(tile.height_m[post]));
      else REQUIRE(tile.height_m[post] == wanted.height_m[post]);
    }
  }
  CHECK(back.tiles.at({0, 0}).holes == 1);
  CHECK(faults_of(back).empty());
}

TEST_CASE("the same seabed gives the same bytes and checksums") {
  const Folder folder;
  const TileSet set = written(folder.path);
  const std::string other = folder.path + "/again";
  const TileSet again = written(other);
  CHECK(again.tiles == set.tiles);
}

TEST_CASE("verify finds a flipped bit, a missing tile, a wrong scale and a seam") {
  const Folder folder;
  TileSet set = written(folder.path);
  const auto only = [&](const std::string& words) {
    const auto faults = faults_of(open_tile_set(folder.path));
    REQUIRE(faults.size() == 1);
    CHECK_THAT(faults[0], Contains(words));
  };
  SECTION("bit") {
    flip(set.path_of({0, -1}, ".png"), 40);
    only("e+0000_n-0001.png");
  }
  SECTION("missing") {
    std::filesystem::remove(set.path_of({-1, 0}, ".class.png"));
    only("e-0001_n+0000.class.png: cannot be read");
  }
  SECTION("scale") {
    std::ofstream(set.path_of({0, 0}, ".pgw")) << "0.25\n0\n0\n-0.25\n0\n16\n";
    only("e+0000_n+0000.pgw: says something else");
  }
  SECTION("raster of all tiles") {
    std::ofstream(folder.path + "/seabed.vrt", std::ios::app) << " ";
    only("seabed.vrt: says something else");
    std::filesystem::remove(folder.path + "/seabed.vrt");
    only("seabed.vrt: cannot be read");
  }
  SECTION("seam") {
    auto tile = terrain::sample_tile(
        set.grid, {0, 0}, [](double x, double y) { return seabed(x, y) + 2e-4; }, kind);
    set.tiles[{0, 0}] = write_tile(set, {0, 0}, tile);
    write_manifest(set);
    const auto faults = faults_of(open_tile_set(folder.path));
    REQUIRE(faults.size() == 2);
    CHECK_THAT(faults[0], Contains("33 of the posts that it shares with tile (-1, 0) differ"));
  }
}

TEST_CASE("an overview is read back bit-equal; a changed, missing or foreign one is refused") {
  const Folder folder;
  TileSet set = written(folder.path);
  CHECK_THROWS_WITH(read_overview(set), Contains("overview.npy"));
  const std::string path = folder.path + "/" + kOverview;
  Overview overview{.columns = 3, .rows = 2, .height_m = {-20.125F, -19.7F, std::nanf(""), -21.0F, -20.0F, -22.5F}};
  write_overview(set, overview);
  write_manifest(set);
  set = open_tile_set(folder.path);
  const Overview back = read_overview(set);
  CHECK(back.columns == 3);
  CHECK(back.rows == 2);
  REQUIRE(back.height_m.size() == 6);
  CHECK(std::memcmp(back.height_m.data(), overview.height_m.data(), 6 * sizeof(float)) == 0);
  CHECK(faults_of(set).empty());

  const auto refused = [&](const std::string& words) {
    const auto faults = faults_of(open_tile_set(folder.path));
    REQUIRE(faults.size() == 1);
    CHECK_THAT(faults[0], Contains(words));
    CHECK_THROWS_WITH(read_overview(set), Contains(words));
  };
  SECTION("a height") {
    flip(path, 9);
    refused("overview.npy: is not that of the manifest's tiles");
  }
  SECTION("numbers of posts") {
    flip(path, 6 * 4 + 128 - 61);  // the digit of the rows: behind the magic word and 51 letters
    refused("overview.npy: is no overview as this program writes them");
  }
  SECTION("cut off") {
    std::filesystem::resize_file(path, 20);
    refused("overview.npy: is no overview as this program writes them");
  }
  SECTION("gone") {
    std::filesystem::remove(path);
    refused("overview.npy: cannot be read");
  }
  SECTION("of other tiles") {
    const auto deeper = terrain::sample_tile(set.grid, {0, 0}, [](double x, double y) { return seabed(x, y) - 1.0; });
    set.tiles[{0, 0}] = write_tile(set, {0, 0}, deeper);
    CHECK_THROWS_WITH(read_overview(set), Contains("is not that of the manifest's tiles"));
  }
}

TEST_CASE("a tile that 16 bits cannot hold is refused with the remedy") {
  const Folder folder;
  const TileSet set = empty_set(folder.path);
  const auto cliff = terrain::sample_tile(set.grid, {0, 0}, [](double x, double) { return x < 8 ? -30.0 : -10.0; });
  CHECK_THROWS_WITH(write_tile(set, {0, 0}, cliff), Contains("100000 steps") && Contains("use a larger lsb_m"));
}

TEST_CASE("a build goes on where it stopped, and makes anew what belongs to another grid") {
  const Folder folder;
  TileSet set = written(folder.path);
  CHECK(facts_on_disk(set, {0, 0}) == set.tiles.at({0, 0}));
  CHECK(facts_on_disk(set, {5, 5}).sha256.empty());
  set.grid.lsb_m = 1e-3;
  CHECK(facts_on_disk(set, {0, 0}).sha256.empty());
}

TEST_CASE("a folder without a manifest, and a manifest of another version, are refused") {
  const Folder folder;
  CHECK_THROWS_AS(open_tile_set(folder.path), ConfigError);
  written(folder.path);
  std::ofstream(folder.path + "/" + kManifest) << "ensonify: tiles/2\n";
  CHECK_THROWS_WITH(open_tile_set(folder.path), Contains("tiles/2; this program reads tiles/1"));
}

TEST_CASE("a disk that refuses is named") {
  TileSet set = empty_set("/proc/no-such-place");
  const auto tile = terrain::sample_tile(set.grid, {0, 0}, seabed, kind);
  CHECK_THROWS(write_tile(set, {0, 0}, tile));
}

#include "components/terrain/layers_source.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <thread>

#include "components/config/config_error.h"
#include "components/config/config_reader.h"
#include "components/terrain/terrain_source.h"
#include "components/terrain/tile_set_source.h"
#include "kernels/base/random/stream.h"
#include "kernels/seabed/statistics/surface.h"
#include "scenarios/world/testing/sections.h"

using namespace ensonify;
using namespace ensonify::source;
using Catch::WithinAbs;

namespace {

const frames::Geodetic kOrigin{54.0, -10.0};

/// Some of everything, cut off within tiles.
const std::string kMixed = R"(seabed:
  kind: layers
  post_spacing_m: 0.25
  size_m: [300, 200]
  centre_m: [20, -10]
  layers:
    ground: { plane: { depth_m: 20, slope_deg: 1 } }
    swell: { spectral: { rms_m: 1, hurst: 0.8, outer_scale_m: 120, inner_scale_m: 20 } }
    rock:
      spectral: { rms_m: 0.8, outer_scale_m: 60, intermittency: 0.3, rough: { patches: { length_m: 30 } } }
      sediment: 1
    sand: { spectral: { rms_m: 0.03, outer_scale_m: 20 }, join: cover, above: swell, sediment: 2 }
    ripples:
      ripples: { wavelength_m: 2, height_m: 0.15 }
      mask: { sediment: [2], slope_deg: { to: 10, soft: 4 }, of: sand, scale_m: 2 }
    boulders: { boulders: { per_km2: 5000, smallest_radius_m: 0.3, largest_radius_m: 2 }, sediment: 3 }
    scars: { trawl_scars: { per_km2: 100, length_m: 200 } }
    channel: { dredged: { line_m: [[-80, 40, 24], [120, 60, 25]], half_width_m: 8 }, sediment: 4 }
    shells: { mask: { depth_m: { to: 18 }, of: channel }, sediment: 5 }
)";

Seabed seabed_from(const std::string& text, std::uint64_t seed = 7) {
  auto from = ConfigReader::from_text(text, "s.yaml");
  Seabed seabed = read_seabed(from.section("seabed"));
  from.finish();
  seabed.layered.seed = seed;
  return seabed;
}

bool same(std::span<const float> a, std::span<const float> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;  // NaN's bits, too
}

struct Posts {
  std::vector<float> height_m;
  std::vector<std::uint8_t> sediment;
};

Posts sampled(const TerrainSource& source, const PostBlock& block) {
  Posts posts{std::vector<float>(block.size()), std::vector<std::uint8_t>(block.size())};
  source.sample(block, posts.height_m, posts.sediment);
  return posts;
}

std::int64_t post_beyond(const Extent& extent, double spacing_m) {
  return static_cast<std::int64_t>(extent.east_m / spacing_m) + 100;
}

struct Folder {
  std::string path =
      (std::filesystem::temp_directory_path() / ("ensonify-layers-" + std::to_string(::getpid()))).string();
  ~Folder() { std::filesystem::remove_all(path); }
};

}  // namespace

TEST_CASE("baked and generated tiles are bit-equal, in any order, on any number of threads") {
  const Seabed seabed = seabed_from(kMixed);
  const LayersSource generated(seabed, kOrigin);
  const Folder folder;
  tiles::TileSet set;
  set.folder = folder.path;
  set.origin = kOrigin;
  set.grid = {.spacing_m = seabed.post_spacing_m, .cells = 128, .lsb_m = seabed.lsb_m};
  set.made_from = "a test";
  const auto side = static_cast<std::size_t>(set.grid.cells) + 1;
  const auto made = [&](const TerrainSource& source, const terrain::TileKey& key) {
    terrain::Tile tile{set.grid.origin_of(key),         set.grid.spacing_m,
                       static_cast<std::int32_t>(side), static_cast<std::int32_t>(side),
                       std::vector<float>(side * side), std::vector<std::uint8_t>(side * side)};
    fill_tile(source, set.grid, key, tile.height_m, tile.sediment);
    return tile;
  };
  std::vector<terrain::TileKey> keys;
  for (int east = -5; east <= 5; ++east) {
    for (int north = -4; north <= 2; ++north) keys.push_back({east, north});
  }
  for (const auto& key : keys) set.tiles[key] = tiles::write_tile(set, key, made(generated, key));
  tiles::write_manifest(set);
  const TileSetSource baked(folder.path);

  // Another source of the same text, asked backwards by three threads at once.
  const LayersSource again(seabed_from(kMixed), kOrigin);
  std::vector<terrain::Tile> tiles(keys.size());
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 3; ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t i = keys.size() - t; i-- > 0; i -= std::min<std::size_t>(i, 2)) tiles[i] = made(again, keys[i]);
    });
  }
  for (auto& thread : threads) thread.join();
  std::size_t holes = 0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (tiles[i].height_m.empty()) tiles[i] = made(again, keys[i]);
    const terrain::Tile stored = tiles::read_tile(baked.set(), keys[i]);
    REQUIRE(same(tiles[i].height_m, stored.height_m));
    REQUIRE(tiles[i].sediment == stored.sediment);
    for (const float z : stored.height_m) holes += std::isnan(z) ? 1 : 0;
  }
  CHECK(holes > 0);  // the rectangle ends within tiles

  // Blocks of any size at any place, and places between posts.
  const random::Stream draw(1, "blocks");
  for (std::uint64_t n = 0; n < 40; ++n) {
    const auto at = draw.bits(n);
    const PostBlock block{static_cast<std::int64_t>(at[0] % 1000) - 500, static_cast<std::int64_t>(at[1] % 700) - 400,
                          1 + static_cast<int>(at[2] % 90), 1 + static_cast<int>(at[3] % 90), seabed.post_spacing_m};
    Posts some = sampled(generated, block);
    for (float& z : some.height_m) z = terrain::on_lattice(z, seabed.lsb_m);
    const Posts stored = sampled(baked, block);
    REQUIRE(same(some.height_m, stored.height_m));
    REQUIRE(some.sediment == stored.sediment);
    const Vec2 place(-120.0 + 280.0 * draw.uniform(n, 1), -100.0 + 180.0 * draw.uniform(n, 2));
    REQUIRE(generated.height_m(place) == baked.height_m(place));
  }
}

TEST_CASE("every layer shows, and each can be left out without moving another") {
  const LayersSource whole(seabed_from(kMixed), kOrigin);
  const PostBlock block{-400, -400, 800, 700, 0.25};
  const Posts all = sampled(whole, block);
  for (const std::uint8_t of_class : {1, 2, 3, 4, 5}) {
    INFO(int{of_class});
    CHECK(std::count(all.sediment.begin(), all.sediment.end(), of_class) > 100);
  }
  std::string without = kMixed;
  without.replace(without.find("boulders: { boulders:"), 12, "boulders: { use: false, ");
  const Posts some = sampled(LayersSource(seabed_from(without), kOrigin), block);
  int moved = 0;
  for (std::size_t i = 0; i < block.size(); ++i) {
    if (all.sediment[i] >= 3) continue;  // boulders, those that shells cover, those that the channel cut
    moved += !(all.height_m[i] == some.height_m[i]) && std::isfinite(all.height_m[i]) ? 1 : 0;
  }
  CHECK(moved == 0);
  const Posts other = sampled(LayersSource(seabed_from(kMixed, 8), kOrigin), block);
  CHECK_FALSE(same(all.height_m, other.height_m));
}

TEST_CASE("a block that reaches over the seabed's edges has its posts where they are, and holes around them") {
  const Seabed seabed = seabed_from(kMixed);
  const LayersSource source(seabed, kOrigin);
  const Extent extent = source.extent();
  for (const double spacing_m : {seabed.post_spacing_m, 1.3}) {
    const auto post = [&](double m) { return static_cast<std::int64_t>(std::floor(m / spacing_m)); };
    const PostBlock whole{post(extent.west_m) - 9, post(extent.south_m) - 7, 40, 30, spacing_m};
    const Posts cut = sampled(source, whole);
    for (int row = 0; row < whole.rows; ++row) {
      for (int column = 0; column < whole.columns; ++column) {
        const auto k =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(whole.columns) + static_cast<std::size_t>(column);
        const PostBlock alone{whole.first_east + column, whole.first_north + row, 1, 1, spacing_m};
        const Posts one = sampled(source, alone);
        REQUIRE(same({&cut.height_m[k], 1}, one.height_m));
        REQUIRE(cut.sediment[k] == one.sediment[0]);
        REQUIRE(std::isfinite(one.height_m[0]) == extent.contains({whole.east_m(column), whole.north_m(row)}));
      }
    }
  }
  const Posts beyond = sampled(source, {post_beyond(extent, seabed.post_spacing_m), 0, 5, 4, seabed.post_spacing_m});
  CHECK(std::ranges::all_of(beyond.height_m, [](float z) { return std::isnan(z); }));
  CHECK(std::ranges::all_of(beyond.sediment, [](std::uint8_t s) { return s == 0; }));
}

TEST_CASE("wide spacings give a coarser level of the seabed, within the same rectangle", "[long]") {
  const LayersSource source(seabed_from(kMixed), kOrigin);
  const PostBlock block{-16, -16, 32, 32, 11.1};
  const Posts coarse = sampled(source, block);
  double squares = 0.0;
  int known = 0;
  for (int row = 0; row < block.rows; ++row) {
    for (int column = 0; column < block.columns; ++column) {
      const Vec2 place(block.east_m(column), block.north_m(row));
      const float z = coarse.height_m[static_cast<std::size_t>(row) * 32 + static_cast<std::size_t>(column)];
      REQUIRE(std::isfinite(z) == source.extent().contains(place));
      if (!std::isfinite(z)) continue;
      squares += std::pow(z - source.height_m(place), 2);
      ++known;
    }
  }
  // What is finer than 8 m is left out: of the rock 0.8 m (8 / 60)^0.625 = 0.2 m, boulders, the channel's edge.
  CHECK(std::sqrt(squares / known) < 0.4);
  CHECK(source.lowest_m() < -24.5);
  CHECK(source.highest_m() > -19.0);
}

TEST_CASE("a tile set can be the guide of a seabed, and what its cells lack is restored") {
  const Folder folder;
  tiles::TileSet set;
  set.folder = folder.path;
  set.origin = kOrigin;
  set.grid = {.spacing_m = 4.0, .cells = 64, .lsb_m = 2e-4};
  set.made_from = "a test";
  const LayersSource survey(seabed_from("seabed: {kind: layers, post_spacing_m: 4, size_m: [600, 600], layers: {"
                                        "ground: {plane: {depth_m: 30}}, shape: {spectral: {rms_m: 2, outer_scale_m: "
                                        "200}}}}"),
                            kOrigin);
  for (int east = -2; east <= 1; ++east) {
    for (int north = -2; north <= 1; ++north) {
      terrain::Tile tile{set.grid.origin_of({east, north}), 4.0, 65, 65, std::vector<float>(65 * 65),
                         std::vector<std::uint8_t>(65 * 65)};
      fill_tile(survey, set.grid, {east, north}, tile.height_m, tile.sediment);
      set.tiles[{east, north}] = tiles::write_tile(set, {east, north}, tile);
    }
  }
  tiles::write_manifest(set);
  // 10 km x 10 km at 0.1 m on such a guide of 5 m takes less than 50 MB of disk: by bytes a post of these small tiles.
  double bytes = 0.0;
  for (const auto& file : std::filesystem::recursive_directory_iterator(folder.path))
    bytes += file.is_regular_file() ? static_cast<double>(file.file_size()) : 0.0;
  CHECK(bytes / (16 * 65 * 65) * 2001 * 2001 < 50e6);
  const std::string guide =
      "seabed: {kind: layers, post_spacing_m: 0.5, size_m: [400, 400], layers: {ground: {guide: "
      "{tiles: " +
      folder.path + ", cell_m: 4}}";
  const LayersSource smooth(seabed_from(guide + "}}"), kOrigin);
  const LayersSource rough(seabed_from(guide + ", detail: {restored: {guide: ground}}}}"), kOrigin);
  for (const double x : {-80.0, 4.0, 96.0})  // at its own values the guide is itself, to the lattices' steps
    CHECK_THAT(smooth.height_m({x, 2 * x}), WithinAbs(survey.height_m({x, 2 * x}), 5e-4));
  const frames::Geodetic elsewhere{kOrigin.latitude_deg + 0.01, kOrigin.longitude_deg};
  CHECK_THROWS_WITH(LayersSource(seabed_from(guide + "}}"), elsewhere),
                    Catch::Contains("seabed.layers.ground: the guide's tiles: their origin is") &&
                        Catch::Contains("allowed: the same"));
  const PostBlock block{-128, -128, 256, 256, 0.5};
  const auto rms_of = [&](const TerrainSource& source) {
    const relief_statistics::Surface surface{256, 256, 0.5, sampled(source, block).height_m};
    double squares = 0.0;
    relief_statistics::Patch patch;
    int n = 0;
    for (int row = 0; row + 9 <= 256; row += 9) {
      for (int column = 0; column + 9 <= 256; column += 9) {
        REQUIRE(relief_statistics::patch_of(surface, column, row, 9, patch));
        for (const double z : patch.residual_m) squares += z * z;
        n += 81;
      }
    }
    return std::sqrt(squares / n);
  };
  CHECK(rms_of(rough) > 2.0 * rms_of(smooth));  // in 4.5 m, the smooth one has the curvature of waves above 8 m
}

TEST_CASE("what only shows when a seabed is made is refused with the layer's name") {
  const auto refused = [](const std::string& layers) -> std::string {
    try {
      const LayersSource source(seabed_from("seabed: {kind: layers, post_spacing_m: 0.5, layers: {" + layers + "}}"),
                                kOrigin);
      return "";
    } catch (const ConfigError& error) {
      return error.what();
    }
  };
  CHECK_THAT(refused("hill: {spectral: {rms_m: 0.1, outer_scale_m: 20}}, up: {plane: {depth_m: -10}}"),
             Catch::Contains("seabed.layers: make a seabed that is nowhere under water"));
  CHECK_THAT(refused("a: {plane: {}}, b: {boulders: {per_km2: 1e8, smallest_radius_m: 0.1, largest_radius_m: 0.1}}, "
                     "c: {restored: {guide: a}}"),
             Catch::Contains("seabed.layers.c: guide: a is not a layer that is a guide"));
}

// How fast tiles come from disk: posts per second, two threads as the pager has, files in the page cache. The floor is
// what can not be left out: the images inflated into memory by zlib alone, without a filter, a checksum or a
// conversion. The case is checked before it is timed: a tile that is read is the tile that was written.
#include <benchmark/benchmark.h>
#include <zlib.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "components/terrain/terrain_source.h"
#include "components/terrain/tile_set_source.h"
#include "components/terrain/tiles/file_bytes.h"
#include "components/terrain/tiles/tile_set.h"

using namespace ensonify;

namespace {

constexpr int kTiles = 12;
constexpr std::size_t kSide = 1025;

/// Sand waves and noise of a few centimetres on a slope, as a survey at 0.1 m has, with patches of three classes.
float height_at(std::uint32_t column, std::uint32_t row) {
  const std::uint32_t mixed = (column * 2654435761U) ^ (row * 2246822519U);
  const double noise = static_cast<double>((mixed ^ (mixed >> 15)) % 1000) / 1000.0;
  return static_cast<float>(-40.0 + 0.002 * column + 0.15 * std::sin(0.06 * column) * std::cos(0.03 * row) +
                            0.03 * noise);
}

/// A set in a folder of this process, removed with it.
struct MadeSet {
  MadeSet() {
    std::vector<std::vector<float>> heights;
    set.folder = (std::filesystem::temp_directory_path() / "ensonify_bench_tiles").string();
    set.grid = {{0.0, 0.0}, 0.1, 1024, 5e-4};
    for (int i = 0; i < kTiles; ++i) {
      const terrain::TileKey key{i, 0};
      terrain::Tile tile{set.grid.origin_of(key), set.grid.spacing_m, 1025, 1025, {}, {}};
      for (std::uint32_t row = 0; row < 1025; ++row) {
        for (std::uint32_t column = 0; column < 1025; ++column) {
          const auto east = static_cast<std::uint32_t>(i) * 1024 + column;
          tile.height_m.push_back(terrain::on_lattice(height_at(east, row), set.grid.lsb_m));
          tile.sediment.push_back(static_cast<std::uint8_t>((east / 150 + row / 130) % 3));
        }
      }
      set.tiles[key] = write_tile(set, key, tile);
      heights.push_back(tile.height_m);
    }
    write_manifest(set);
    check(heights);
  }
  ~MadeSet() { std::filesystem::remove_all(set.folder); }
  MadeSet(const MadeSet&) = delete;
  MadeSet& operator=(const MadeSet&) = delete;

  void check(const std::vector<std::vector<float>>& heights) const {
    const source::TileSetSource source(set.folder);
    std::vector<float> height_m(kSide * kSide);
    std::vector<std::uint8_t> sediment(height_m.size());
    for (int i = 0; i < kTiles; ++i) {
      source::fill_tile(source, set.grid, {i, 0}, height_m, sediment);
      if (height_m == heights[static_cast<std::size_t>(i)]) continue;
      std::fprintf(stderr, "tile %d: what is read is not what was written\n", i);
      std::exit(1);
    }
  }

  tiles::TileSet set;
};

const MadeSet& made_set() {
  static const MadeSet made;
  return made;
}

void count_posts(benchmark::State& state) { state.SetItemsProcessed(state.iterations() * 1025 * 1025); }

/// As the pager does; twelve tiles in turn, of which the source keeps eight, so that none is still there.
void page_in_disk(benchmark::State& state) {
  static const source::TileSetSource source(made_set().set.folder);
  const auto& grid = made_set().set.grid;
  std::vector<float> height_m(kSide * kSide);
  std::vector<std::uint8_t> sediment(height_m.size());
  int i = state.thread_index();
  for (auto _ : state) {
    source::fill_tile(source, grid, {i, 0}, height_m, sediment);
    benchmark::DoNotOptimize(height_m.data());
    i = (i + 2) % kTiles;
  }
  count_posts(state);
}

/// Appends what the IDAT chunks of a PNG hold.
void append_data(const std::vector<std::uint8_t>& png, std::vector<std::uint8_t>& data) {
  for (std::size_t at = 8; at + 12 <= png.size();) {
    const std::size_t size = static_cast<std::size_t>(png[at]) << 24 | static_cast<std::size_t>(png[at + 1]) << 16 |
                             static_cast<std::size_t>(png[at + 2]) << 8 | png[at + 3];
    if (png[at + 4] == 'I' && png[at + 5] == 'D') {
      data.insert(data.end(), png.begin() + static_cast<std::ptrdiff_t>(at + 8),
                  png.begin() + static_cast<std::ptrdiff_t>(at + 8 + size));
    }
    at += size + 12;
  }
}

void floor_inflate(benchmark::State& state) {
  const auto& set = made_set().set;
  std::vector<std::uint8_t> data[2];
  append_data(tiles::read_file(set.path_of({0, 0}, ".png")), data[0]);
  append_data(tiles::read_file(set.path_of({0, 0}, ".class.png")), data[1]);
  std::vector<std::uint8_t> image(1025 * (1025 * 2 + 1));
  for (auto _ : state) {
    for (const auto& packed : data) {
      uLongf size = image.size();
      if (uncompress(image.data(), &size, packed.data(), packed.size()) != Z_OK) std::exit(1);
      benchmark::DoNotOptimize(image.data());
    }
  }
  count_posts(state);
}

BENCHMARK(page_in_disk)->Threads(2)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(page_in_disk)->Unit(benchmark::kMillisecond);
BENCHMARK(floor_inflate)->Unit(benchmark::kMillisecond);

}  // namespace

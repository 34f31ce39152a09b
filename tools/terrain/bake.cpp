#include "tools/terrain/bake.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>
#include <vector>

#include "components/errors/exit_error.h"
#include "components/runtime/tool.h"
#include "components/terrain/terrain_source.h"
#include "components/terrain/tile_set_source.h"
#include "components/terrain/tiles/file_bytes.h"
#include "components/terrain/tiles/overview.h"
#include "components/terrain/tiles/tile_set.h"

namespace ensonify::terrain_tool {
namespace {

constexpr const char* kSource = "source.yaml";

/// Tiles that touch the terrain's extent, from the south-west.
std::vector<terrain::TileKey> keys_of(const terrain::TileGrid& grid, const source::Extent& extent) {
  // A terrain that ends on a tile's edge does not need the tile behind.
  const auto first = [&](double m) { return static_cast<std::int32_t>(std::floor(m / grid.side_m())); };
  const auto last = [&](double m) { return static_cast<std::int32_t>(std::ceil(m / grid.side_m())) - 1; };
  std::vector<terrain::TileKey> keys;
  for (auto east = first(extent.west_m); east <= last(extent.east_m); ++east) {
    for (auto north = first(extent.south_m); north <= last(extent.north_m); ++north) keys.push_back({east, north});
  }
  return keys;
}

terrain::Tile tile_of(const source::TerrainSource& source, const terrain::TileGrid& grid, const terrain::TileKey& key) {
  const int posts = grid.cells + 1;
  const auto count = static_cast<std::size_t>(posts) * static_cast<std::size_t>(posts);
  terrain::Tile tile{
      grid.origin_of(key), grid.spacing_m, posts, posts, std::vector<float>(count), std::vector<std::uint8_t>(count)};
  source::fill_tile(source, grid, key, tile.height_m, tile.sediment);
  return tile;
}

/// Says now and then how far the work is.
class Progress {
 public:
  explicit Progress(std::size_t all) : all_(all) {}
  void done(std::size_t count) {
    using namespace std::chrono;
    const auto now = steady_clock::now();
    if (now - reported_ < seconds(2)) return;
    reported_ = now;
    const double spent_s = duration<double>(now - began_).count();
    fmt::print(stderr, "{} of {} tiles, about {:.0f} s left\n", count, all_,
               spent_s / static_cast<double>(count) * static_cast<double>(all_ - count));
  }

 private:
  std::size_t all_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now(), reported_ = began_;
};

/// Makes what is missing, in parallel; which thread makes a tile changes nothing in it.
void make_tiles(const source::TerrainSource& source, const std::vector<terrain::TileKey>& keys, int threads,
                tiles::TileSet& set) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr error;
  std::size_t count = 0;
  Progress progress(keys.size());
  const auto work = [&] {
    for (std::size_t i = next++; i < keys.size() && !interrupted(); i = next++) {
      try {
        auto facts = tiles::facts_on_disk(set, keys[i]);
        bool known = !facts.sha256.empty();
        if (!known) {
          const auto tile = tile_of(source, set.grid, keys[i]);
          known = std::any_of(tile.height_m.begin(), tile.height_m.end(), [](float h) { return std::isfinite(h); });
          if (known) facts = tiles::write_tile(set, keys[i], tile);
        }
        const std::scoped_lock lock(mutex);
        if (known) set.tiles[keys[i]] = facts;
        progress.done(++count);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!error) error = std::current_exception();
        next = keys.size();
      }
    }
  };
  std::vector<std::thread> pool;
  for (int i = 1; i < threads; ++i) pool.emplace_back(work);
  work();
  for (auto& thread : pool) thread.join();
  if (error) std::rethrow_exception(error);
}

}  // namespace

BakeOptions::BakeOptions() : threads(static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))) {}

void BakeOptions::add_to(CLI::App& app) {
  app.add_option("--cells", cells, "cells per side of a tile")->check(CLI::Range(16, 8192))->capture_default_str();
  app.add_option("--threads", threads, "that make tiles side by side")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
}

void claim(const std::string& folder, const std::string& source_text) {
  const std::string path = folder + "/" + kSource;
  if (std::filesystem::exists(path)) {
    const auto bytes = tiles::read_file(path);
    if (std::string(bytes.begin(), bytes.end()) == source_text) return;
    throw UserError(folder + ": holds tiles of another seabed or other options (" + kSource +
                    " says which); give another folder, or remove this one");
  }
  if (std::filesystem::exists(folder + "/" + tiles::kManifest))
    throw UserError(folder + ": holds a tile set that was not built here; give another folder");
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw UserError(folder + ": cannot be made: " + error.message());
  try {
    tiles::write_file(path, source_text);
  } catch (const tiles::TileError& refused) {
    throw UserError(refused.what());
  }
}

bool bake(const source::TerrainSource& source, const std::string& what, int threads, tiles::TileSet& set) {
  try {
    make_tiles(source, keys_of(set.grid, source.extent()), threads, set);
    if (interrupted()) return false;
    if (set.tiles.empty()) throw UserError(what + ": the seabed has no height anywhere");
    const source::Overview overview = source::TileSetSource(set).overview();
    tiles::write_overview(set, {overview.posts.columns, overview.posts.rows, overview.height_m});
    tiles::write_manifest(set);
  } catch (const tiles::TileError& error) {
    throw UserError(error.what());
  }
  return true;
}

}  // namespace ensonify::terrain_tool

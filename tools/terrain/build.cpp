#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>

#include "components/runtime/config/config_node.h"
#include "components/runtime/config/scenario.h"
#include "components/runtime/exit_error.h"
#include "components/runtime/terrain/source_of.h"
#include "components/runtime/tiles/file_bytes.h"
#include "components/runtime/tiles/tile_set.h"
#include "components/runtime/tool.h"
#include "tools/terrain/verbs.h"

namespace ensonify::terrain_tool {
namespace {

constexpr const char* kSource = "source.yaml";

struct Options {
  std::string scenario, folder;
  double lsb_m = 2e-4;
  int cells = 1024;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::string raster_crs;
  int raster_band = 1;
  std::optional<double> raster_nodata;
};

/// What the tiles follow from; equal texts give equal tiles.
std::string source_text(const Options& options) {
  auto document = parse_config_file(options.scenario);
  return fmt::format(
             "# what these tiles were built from\nlsb_m: {}\ncells: {}\nraster_band: {}\nraster_crs: "
             "\"{}\"\nraster_nodata: {}\n",
             options.lsb_m, options.cells, options.raster_band, options.raster_crs,
             options.raster_nodata ? fmt::format("{}", *options.raster_nodata) : "none") +
         "scenario:\n" + to_canonical_yaml(document.root);
}

/// A folder that was begun with the same input is gone on with; any other that holds tiles is left alone.
void claim(const Options& options) {
  const std::string path = options.folder + "/" + kSource, text = source_text(options);
  if (std::filesystem::exists(path)) {
    const auto bytes = tiles::read_file(path);
    if (std::string(bytes.begin(), bytes.end()) == text) return;
    throw UserError(options.folder + ": holds tiles of another seabed or other options (" + kSource +
                    " says which); give another folder, or remove this one");
  }
  if (std::filesystem::exists(options.folder + "/" + tiles::kManifest))
    throw UserError(options.folder + ": holds a tile set that was not built here; give another folder");
  std::error_code error;
  std::filesystem::create_directories(options.folder, error);
  if (error) throw UserError(options.folder + ": cannot be made: " + error.message());
  tiles::write_file(path, text);
}

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
  const source::PostBlock block{std::int64_t{key.east} * grid.cells, std::int64_t{key.north} * grid.cells, posts, posts,
                                grid.spacing_m};
  terrain::Tile tile{grid.origin_of(key),
                     grid.spacing_m,
                     posts,
                     posts,
                     std::vector<float>(block.size()),
                     std::vector<std::uint8_t>(block.size())};
  source.sample(block, tile.height_m, tile.sediment);
  for (float& height : tile.height_m) height = terrain::on_lattice(height, grid.lsb_m);
  return tile;
}

/// Says now and then how far the work is.
class Progress {
 public:
  explicit Progress(std::size_t all) : all_(all) {}
  void done(std::size_t count) {
    using namespace std::chrono;
    const auto now = steady_clock::now();
    if (now - told_ < seconds(2)) return;
    told_ = now;
    const double spent_s = duration<double>(now - began_).count();
    fmt::print(stderr, "{} of {} tiles, about {:.0f} s left\n", count, all_,
               spent_s / static_cast<double>(count) * static_cast<double>(all_ - count));
  }

 private:
  std::size_t all_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now(), told_ = began_;
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

int build(const Options& options) {
  const Scenario scenario = read_scenario(options.scenario);
  const source::TerrainOptions terrain{scenario.site, scenario.seabed, options.raster_crs, options.raster_band,
                                       options.raster_nodata};
  const auto source = source::source_of(terrain);
  claim(options);
  tiles::TileSet set;
  set.folder = options.folder;
  set.origin = source->origin();
  set.grid = {frames::Vec2::Zero(), source::post_spacing_m(terrain, *source), options.cells, options.lsb_m};
  set.made_from = std::filesystem::path(options.scenario).parent_path().filename().string() + "/" +
                  std::filesystem::path(options.scenario).filename().string();
  try {
    make_tiles(*source, keys_of(set.grid, source->extent()), options.threads, set);
    if (interrupted()) return kExitInterrupted;  // the next build goes on from here
    if (set.tiles.empty()) throw UserError(options.scenario + ": the seabed has no height anywhere");
    tiles::write_manifest(set);
  } catch (const tiles::TileError& error) {
    throw UserError(error.what());
  }
  fmt::print("{}: {} tiles of {} x {} posts {} m apart\n", options.folder, set.tiles.size(), set.grid.cells + 1,
             set.grid.cells + 1, set.grid.spacing_m);
  return kExitOk;
}

}  // namespace

Verb add_build(CLI::App& parent) {
  auto options = std::make_shared<Options>();
  CLI::App* app = parent.add_subcommand(
      "build", "Bakes a scenario's seabed into a tile set. A build that was stopped goes on where it was.");
  app->add_option("scenario", options->scenario, "scenario file (YAML)")->required()->check(CLI::ExistingFile);
  app->add_option("folder", options->folder, "folder of the tile set, made if need be")->required();
  app->add_option("--lsb-m", options->lsb_m, "step of heights, m")
      ->check(CLI::Range(1e-6, 10.0))
      ->capture_default_str();
  app->add_option("--cells", options->cells, "cells per side of a tile")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  app->add_option("--threads", options->threads, "that make tiles side by side")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app->add_option("--raster-crs", options->raster_crs, "reference system of a raster that names none, e.g. EPSG:32619");
  app->add_option("--raster-band", options->raster_band, "band of a raster")->capture_default_str();
  app->add_option("--raster-nodata", options->raster_nodata, "mark for missing values of a raster that declares none");
  return {app, [options] { return build(*options); }};
}

}  // namespace ensonify::terrain_tool

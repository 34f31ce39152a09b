#include "components/terrain/tiles/tile_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <span>

#include "components/config/config_reader.h"
#include "components/terrain/tiles/file_bytes.h"
#include "components/terrain/tiles/tile_text.h"

namespace ensonify::tiles {
namespace {

void read_grid(ConfigReader& from, terrain::TileGrid& grid) {
  from.required("spacing_m", grid.spacing_m, 1e-4, 1e5);
  from.required("cells", grid.cells, 1, 8192);
  from.required("lsb_m", grid.lsb_m, 1e-6, 10.0);
}

terrain::TileKey read_facts(ConfigReader& from, TileFacts& facts) {
  constexpr double kFar = 1e6;
  terrain::TileKey key;
  from.required("east", key.east, -99999, 99999);
  from.required("north", key.north, -99999, 99999);
  from.required("offset_steps", facts.offset_steps);
  from.required("lowest_m", facts.lowest_m, -kFar, kFar);
  from.required("highest_m", facts.highest_m, -kFar, kFar);
  from.required("holes", facts.holes, 0, std::numeric_limits<std::int64_t>::max());
  from.required("sha256", facts.sha256);
  return key;
}

void read_tile_format(ConfigReader& from, const std::string& wanted) {
  std::string format;
  from.required("ensonify", format);
  if (!format.empty() && format != wanted) from.problem("ensonify", "is " + format + "; this program reads " + wanted);
}

/// A tile as its files hold it, rows from the north.
struct Planes {
  std::int64_t offset_steps = 0;
  GreyImage<std::uint16_t> height;
  GreyImage<std::uint8_t> sediment;
};

/// Row and column of an image's value in a tile, whose rows start in the south.
std::size_t post_of(const terrain::Tile& tile, int row, int column) { return tile.post(column, tile.rows - 1 - row); }

std::string checksum(const Planes& planes) {
  const std::string head = fmt::format("{} {}\n", planes.height.side, planes.offset_steps);
  Sha256 sum;
  sum.add(std::as_bytes(std::span(head)));
  sum.add(std::as_bytes(std::span(planes.height.value)));
  sum.add(std::as_bytes(std::span(planes.sediment.value)));
  return sum.digest();
}

struct Measured {
  Planes planes;
  TileFacts facts;
};

Measured measure(const TileSet& set, const terrain::TileKey& key, const terrain::Tile& tile) {
  const int side = set.grid.cells + 1;
  if (tile.columns != side || tile.rows != side || tile.spacing_m != set.grid.spacing_m || terrain::fault_of(tile))
    throw TileError(fmt::format("tile ({}, {}): does not fit a set of {} x {} posts", key.east, key.north, side, side));
  const double lsb_m = set.grid.lsb_m;
  const auto step_of = [&](float height_m) -> std::int64_t {
    return std::llround(static_cast<double>(height_m) / lsb_m);
  };
  std::int64_t lowest = std::numeric_limits<std::int64_t>::max(), highest = std::numeric_limits<std::int64_t>::min();
  Measured m;
  for (const float height_m : tile.height_m) {
    if (!std::isfinite(height_m)) {
      ++m.facts.holes;
      continue;
    }
    lowest = std::min(lowest, step_of(height_m));
    highest = std::max(highest, step_of(height_m));
  }
  if (lowest > highest) lowest = highest = 0;
  if (highest - lowest >= kMostSteps) {
    throw TileError(fmt::format(
        "tile ({}, {}): {:.3f} m between its lowest and highest post are {} steps of {} m, and "
        "at most {} are allowed: use a larger lsb_m or smaller tiles",
        key.east, key.north, static_cast<double>(highest - lowest) * lsb_m, highest - lowest, lsb_m, kMostSteps - 1));
  }
  m.facts.offset_steps = m.planes.offset_steps = lowest - 1;
  m.facts.lowest_m = static_cast<double>(lowest) * lsb_m;
  m.facts.highest_m = static_cast<double>(highest) * lsb_m;
  m.planes.height = {side, std::vector<std::uint16_t>(tile.height_m.size())};
  m.planes.sediment = {side, std::vector<std::uint8_t>(tile.height_m.size())};
  std::size_t k = 0;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column, ++k) {
      const std::size_t post = post_of(tile, row, column);
      const float height_m = tile.height_m[post];
      if (std::isfinite(height_m))
        m.planes.height.value[k] = static_cast<std::uint16_t>(step_of(height_m) - lowest + 1);
      if (!tile.sediment.empty()) m.planes.sediment.value[k] = tile.sediment[post];
    }
  }
  m.facts.sha256 = checksum(m.planes);
  return m;
}

}  // namespace

std::string TileSet::path_of(const terrain::TileKey& key, const std::string& ending) const {
  return fmt::format("{}/tiles/e{:+05d}_n{:+05d}{}", folder, key.east, key.north, ending);
}

TileFacts facts_on_disk(const TileSet& set, const terrain::TileKey& key) {
  const std::string path = set.path_of(key, ".yaml");
  if (!std::filesystem::exists(path)) return {};
  TileFacts facts;
  try {
    auto from = ConfigReader::from_file(path);
    terrain::TileGrid grid;
    read_tile_format(from, kTileFormat);
    read_grid(from, grid);
    const terrain::TileKey read = read_facts(from, facts);
    from.finish();
    const bool fits = read == key && grid.spacing_m == set.grid.spacing_m && grid.cells == set.grid.cells &&
                      grid.lsb_m == set.grid.lsb_m;
    return fits ? facts : TileFacts{};
  } catch (const ConfigError&) {
    return {};  // another version's, or not ours: it is made anew
  }
}

TileSet open_tile_set(const std::string& folder) {
  auto from = ConfigReader::from_file(folder + "/" + kManifest);
  TileSet set;
  set.folder = folder;
  read_tile_format(from, kFormat);
  auto origin = from.section("origin");
  origin.required("latitude_deg", set.origin.latitude_deg, -90, 90);
  origin.required("longitude_deg", set.origin.longitude_deg, -180, 180);
  read_grid(from, set.grid);
  from.required("made_from", set.made_from);
  from.optional("overview_sha256", set.overview_sha256);
  for (auto& tile : from.list("tiles")) {
    TileFacts facts;
    const terrain::TileKey key = read_facts(tile, facts);
    if (!set.tiles.emplace(key, facts).second)
      tile.problem("east", fmt::format("tile ({}, {}) is listed twice", key.east, key.north));
  }
  if (from.good() && set.tiles.empty()) from.problem("tiles", "the set has no tile");
  from.finish();
  return set;
}

void write_manifest(const TileSet& set) {
  std::string text = fmt::format(
      "# A seabed on disk (docs/manual/tiles.md). East and north count tiles from the world's origin.\nensonify: {}\n"
      "made_from: \"{}\"\norigin: {{ latitude_deg: {}, longitude_deg: {} }}\n",
      kFormat, set.made_from, set.origin.latitude_deg, set.origin.longitude_deg);
  text += grid_text(set);
  if (!set.overview_sha256.empty()) text += "overview_sha256: " + set.overview_sha256 + "\n";
  text += "tiles:\n";
  for (const auto& [key, facts] : set.tiles) text += "  - { " + facts_text(key, facts, ", ") + " }\n";
  write_file(set.folder + "/seabed.vrt", vrt_text(set));
  write_file(set.folder + "/" + kManifest, text);
}

TileFacts write_tile(const TileSet& set, const terrain::TileKey& key, const terrain::Tile& tile) {
  const Measured measured = measure(set, key, tile);
  std::filesystem::create_directories(set.folder + "/tiles");
  write_file(set.path_of(key, ".png"), encode_png(measured.planes.height));
  write_file(set.path_of(key, ".class.png"), encode_png(measured.planes.sediment));
  write_file(set.path_of(key, ".pgw"), world_file(set, key));
  write_file(set.path_of(key, ".yaml"), sidecar_text(set, key, measured.facts));
  return measured.facts;
}

terrain::Tile read_tile(const TileSet& set, const terrain::TileKey& key) {
  const auto facts = set.tiles.find(key);
  if (facts == set.tiles.end()) throw TileError(fmt::format("tile ({}, {}) is not in the set", key.east, key.north));
  const int side = set.grid.cells + 1;
  Planes planes{.offset_steps = facts->second.offset_steps};
  const auto decoded = [&](const std::string& path, auto& image) {
    const auto bytes = read_file(path);
    try {
      decode_png(bytes, side, image);
    } catch (const TileError& error) {
      throw TileError(path + ": " + error.what());
    }
  };
  decoded(set.path_of(key, ".png"), planes.height);
  decoded(set.path_of(key, ".class.png"), planes.sediment);
  if (checksum(planes) != facts->second.sha256)
    throw TileError(set.path_of(key, ".png") + ": heights or classes are not those of the manifest (SHA-256)");
  terrain::Tile tile{set.grid.origin_of(key), set.grid.spacing_m, side, side, {}, {}};
  tile.height_m.resize(planes.height.value.size());
  tile.sediment.resize(planes.sediment.value.size());
  std::size_t k = 0;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column, ++k) {
      const std::size_t post = post_of(tile, row, column);
      const std::uint16_t value = planes.height.value[k];
      tile.height_m[post] = value == 0
                                ? std::numeric_limits<float>::quiet_NaN()
                                : static_cast<float>(static_cast<double>(planes.offset_steps + value) * set.grid.lsb_m);
      tile.sediment[post] = planes.sediment.value[k];
    }
  }
  return tile;
}

}  // namespace ensonify::tiles

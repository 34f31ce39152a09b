#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "components/config/config_reader.h"
#include "components/terrain/tiles/file_bytes.h"
#include "components/terrain/tiles/sidecar.h"
#include "components/terrain/tiles/tile_set.h"

namespace ensonify::tiles {
namespace {

std::string facts_text(const terrain::TileKey& key, const TileFacts& facts, const char* between) {
  return fmt::format(
      "east: {1}{0}north: {2}{0}offset_steps: {3}{0}lowest_m: {4}{0}highest_m: {5}{0}holes: {6}{0}sha256: {7}", between,
      key.east, key.north, facts.offset_steps, facts.lowest_m, facts.highest_m, facts.holes, facts.sha256);
}

std::string grid_text(const TileSet& set) {
  return fmt::format("spacing_m: {}\ncells: {}\nlsb_m: {}\n", set.grid.spacing_m, set.grid.cells, set.grid.lsb_m);
}

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

constexpr const char* kTileFormat = "tile/1";

}  // namespace

std::string vrt_text(const TileSet& set) {
  terrain::TileKey least{std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max()};
  terrain::TileKey most{std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::min()};
  for (const auto& [key, facts] : set.tiles) {
    least = {std::min(least.east, key.east), std::min(least.north, key.north)};
    most = {std::max(most.east, key.east), std::max(most.north, key.north)};
  }
  const int cells = set.grid.cells, side = cells + 1;
  const double s = set.grid.spacing_m;
  const frames::Vec2 west_south = set.grid.origin_of(least);
  const double north_m = set.grid.origin_of(most).y() + set.grid.side_m();
  std::string text = fmt::format(
      "<VRTDataset rasterXSize=\"{}\" rasterYSize=\"{}\">\n"
      "  <SRS>+proj=tmerc +lat_0={} +lon_0={} +k=1 +x_0=0 +y_0=0 +ellps=WGS84 +units=m +no_defs</SRS>\n"
      "  <GeoTransform>{}, {}, 0, {}, 0, {}</GeoTransform>\n"
      "  <VRTRasterBand dataType=\"Float32\" band=\"1\">\n"
      "    <NoDataValue>nan</NoDataValue>\n    <UnitType>m</UnitType>\n",
      (most.east - least.east + 1) * cells + 1, (most.north - least.north + 1) * cells + 1, set.origin.latitude_deg,
      set.origin.longitude_deg, west_south.x() - 0.5 * s, s, north_m + 0.5 * s, -s);
  for (const auto& [key, facts] : set.tiles) {
    const std::string file = std::filesystem::path(set.path_of(key, ".png")).filename().string();
    text += fmt::format(
        "    <ComplexSource>\n      <SourceFilename relativeToVRT=\"1\">tiles/{0}</SourceFilename>\n"
        "      <SourceBand>1</SourceBand>\n"
        "      <SourceProperties RasterXSize=\"{3}\" RasterYSize=\"{3}\" DataType=\"UInt16\"/>\n"
        "      <SrcRect xOff=\"0\" yOff=\"0\" xSize=\"{3}\" ySize=\"{3}\"/>\n"
        "      <DstRect xOff=\"{1}\" yOff=\"{2}\" xSize=\"{3}\" ySize=\"{3}\"/>\n"
        "      <NODATA>0</NODATA>\n      <ScaleOffset>{4}</ScaleOffset>\n      <ScaleRatio>{5}</ScaleRatio>\n"
        "    </ComplexSource>\n",
        file, (key.east - least.east) * cells, (most.north - key.north) * cells, side,
        static_cast<double>(facts.offset_steps) * set.grid.lsb_m, set.grid.lsb_m);
  }
  return text + "  </VRTRasterBand>\n</VRTDataset>\n";
}

std::string sidecar_text(const TileSet& set, const terrain::TileKey& key, const TileFacts& facts) {
  return fmt::format(
             "# height in m = (offset_steps + value) * lsb_m, up from chart datum; value 0 is a hole\nensonify: {}\n",
             kTileFormat) +
         grid_text(set) + facts_text(key, facts, "\n") + "\n";
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

}  // namespace ensonify::tiles

#include "components/terrain/tiles/tile_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

namespace ensonify::tiles {

std::string facts_text(const terrain::TileKey& key, const TileFacts& facts, const char* between) {
  return fmt::format(
      "east: {1}{0}north: {2}{0}offset_steps: {3}{0}lowest_m: {4}{0}highest_m: {5}{0}holes: {6}{0}sha256: {7}", between,
      key.east, key.north, facts.offset_steps, facts.lowest_m, facts.highest_m, facts.holes, facts.sha256);
}

std::string grid_text(const TileSet& set) {
  return fmt::format("spacing_m: {}\ncells: {}\nlsb_m: {}\n", set.grid.spacing_m, set.grid.cells, set.grid.lsb_m);
}

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

std::string world_file(const TileSet& set, const terrain::TileKey& key) {
  const frames::Vec2 corner = set.grid.origin_of(key);
  return fmt::format("{}\n0\n0\n{}\n{}\n{}\n", set.grid.spacing_m, -set.grid.spacing_m, corner.x(),
                     corner.y() + set.grid.side_m());
}

}  // namespace ensonify::tiles

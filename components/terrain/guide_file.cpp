#include "components/terrain/guide_file.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "components/terrain/raster_source.h"
#include "components/terrain/tile_set_source.h"

namespace ensonify::source {
namespace {

constexpr std::size_t kMostCells = 64'000'000;  // 256 MB

std::unique_ptr<TerrainSource> opened(const layers::Guide& guide, const frames::Geodetic& origin) {
  if (guide.tiles_folder.empty()) {
    RasterOptions options;
    options.path = guide.raster;
    options.values_are_depths = guide.values_are_depths;
    return std::make_unique<RasterSource>(options, origin);
  }
  auto tiles = std::make_unique<TileSetSource>(guide.tiles_folder);
  if (const std::string fault = fault_of_origin(tiles->origin(), origin); !fault.empty())
    throw std::invalid_argument("the guide's tiles: their origin " + fault + "; allowed: the same");
  return tiles;
}

relief::Raster read(const layers::Guide& guide, const LayeredSeabed& seabed, const frames::Geodetic& origin) {
  const auto file = opened(guide, origin);
  const frames::Vec2 corner = seabed.centre_enu_m - 0.5 * seabed.size_m;
  PostBlock block;
  block.spacing_m = guide.cell_m;
  block.first_east = static_cast<std::int64_t>(std::floor(corner.x() / guide.cell_m));
  block.first_north = static_cast<std::int64_t>(std::floor(corner.y() / guide.cell_m));
  block.columns = static_cast<int>(std::ceil(seabed.size_m.x() / guide.cell_m)) + 2;
  block.rows = static_cast<int>(std::ceil(seabed.size_m.y() / guide.cell_m)) + 2;
  if (block.size() > kMostCells)
    throw std::invalid_argument("the guide would have " + std::to_string(block.size()) +
                                " cells, allowed: " + std::to_string(kMostCells) + "; widen cell_m");
  relief::Raster raster{block.columns, block.rows, guide.cell_m, {block.east_m(0), block.north_m(0)}, {}};
  raster.value.resize(block.size());
  std::vector<std::uint8_t> sediment(block.size());
  file->sample(block, raster.value, sediment);
  const auto holes = std::count_if(raster.value.begin(), raster.value.end(), [](float z) { return std::isnan(z); });
  if (holes > 0)
    throw std::invalid_argument("the guide has no height at " + std::to_string(holes) + " of " +
                                std::to_string(block.size()) + " cells of the seabed; fill it, or narrow size_m");
  return raster;
}

}  // namespace

GuideReader guide_files(const LayeredSeabed& seabed, const frames::Geodetic& origin) {
  return [&seabed, origin](const layers::Guide& guide) { return read(guide, seabed, origin); };
}

}  // namespace ensonify::source

#include "components/terrain_pager/tile_messages.h"

#include <algorithm>

#include "components/terrain/terrain_source.h"

namespace ensonify::pager {

using source::PostBlock;
using source::Vec2;

msg::Tile make_tile(const TerrainSource& terrain, const terrain::TileGrid& grid, const terrain::TileKey& key) {
  const auto side = static_cast<std::size_t>(grid.cells) + 1;
  const Vec2 origin = grid.origin_of(key);
  msg::Tile tile;
  tile.col = key.east;
  tile.row = key.north;
  tile.origin_east_m = origin.x();
  tile.origin_north_m = origin.y();
  tile.spacing_m = grid.spacing_m;
  tile.height_m = msg::Array<float>({side, side});
  tile.sediment = msg::Array<std::uint8_t>({side, side});
  source::fill_tile(terrain, grid, key, tile.height_m.flat(), tile.sediment.flat());
  return tile;
}

msg::Chart make_chart(const TerrainSource& terrain, const source::Overview& overview) {
  const PostBlock& block = overview.posts;
  msg::Chart chart;
  chart.origin_latitude_deg = terrain.origin().latitude_deg;
  chart.origin_longitude_deg = terrain.origin().longitude_deg;
  chart.west_m = block.east_m(0);
  chart.south_m = block.north_m(0);
  chart.east_m = block.east_m(block.columns - 1);
  chart.north_m = block.north_m(block.rows - 1);
  chart.shallowest_m = -terrain.highest_m();
  chart.deepest_m = -terrain.lowest_m();
  chart.spacing_m = block.spacing_m;
  chart.height_m = msg::Array<float>({static_cast<std::size_t>(block.rows), static_cast<std::size_t>(block.columns)});
  std::ranges::copy(overview.height_m, chart.height_m.flat().begin());
  return chart;
}

}  // namespace ensonify::pager

#include "components/terrain_pager/tile_messages.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "components/runtime/terrain/tile_posts.h"

namespace ensonify::pager {
namespace {

constexpr int kChartPosts = 256;

}  // namespace

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

msg::Chart make_chart(const TerrainSource& terrain) {
  const Extent extent = terrain.extent();
  const double side = std::max(extent.east_m - extent.west_m, extent.north_m - extent.south_m);
  PostBlock block;
  block.spacing_m = side / (kChartPosts - 1);
  block.first_east = static_cast<std::int64_t>(std::ceil(extent.west_m / block.spacing_m));
  block.first_north = static_cast<std::int64_t>(std::ceil(extent.south_m / block.spacing_m));
  const auto count = [&](double to, std::int64_t first) {
    return std::clamp(static_cast<int>(std::floor(to / block.spacing_m) - static_cast<double>(first)) + 1, 1,
                      kChartPosts);
  };
  block.columns = count(extent.east_m, block.first_east);
  block.rows = count(extent.north_m, block.first_north);
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
  std::vector<std::uint8_t> sediment(block.size());
  terrain.sample(block, chart.height_m.flat(), sediment);
  return chart;
}

}  // namespace ensonify::pager

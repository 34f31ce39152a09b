#include "components/terrain/terrain_source.h"

#include <algorithm>
#include <cmath>

namespace ensonify::source {

PostBlock overview_posts(const Extent& extent) {
  constexpr int kPosts = 256;
  const double side_m = std::max(extent.east_m - extent.west_m, extent.north_m - extent.south_m);
  PostBlock block;
  block.spacing_m = side_m / (kPosts - 1);
  block.first_east = static_cast<std::int64_t>(std::ceil(extent.west_m / block.spacing_m));
  block.first_north = static_cast<std::int64_t>(std::ceil(extent.south_m / block.spacing_m));
  const auto count = [&](double to_m, std::int64_t first) {
    return std::clamp(static_cast<int>(std::floor(to_m / block.spacing_m) - static_cast<double>(first)) + 1, 1, kPosts);
  };
  block.columns = count(extent.east_m, block.first_east);
  block.rows = count(extent.north_m, block.first_north);
  return block;
}

Overview TerrainSource::overview() const {
  Overview overview{.posts = overview_posts(extent()), .height_m = {}, .fault = {}};
  overview.height_m.resize(overview.posts.size());
  std::vector<std::uint8_t> sediment(overview.posts.size());
  sample(overview.posts, overview.height_m, sediment);
  return overview;
}

void fill_tile(const TerrainSource& source, const terrain::TileGrid& grid, const terrain::TileKey& key,
               std::span<float> height_m, std::span<std::uint8_t> sediment) {
  const int posts = grid.cells + 1;
  source.sample(
      {std::int64_t{key.east} * grid.cells, std::int64_t{key.north} * grid.cells, posts, posts, grid.spacing_m},
      height_m, sediment);
  if (source.lsb_m() == grid.lsb_m) return;  // they are on it
  for (float& height : height_m) height = terrain::on_lattice(height, grid.lsb_m);
}

}  // namespace ensonify::source

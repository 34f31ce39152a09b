#include "components/terrain/tile_posts.h"

namespace ensonify::source {

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

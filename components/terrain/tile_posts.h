#pragma once

#include "components/terrain/terrain_source.h"

namespace ensonify::source {

/// The posts of a tile on its set's lattice of heights, whether it is baked or made on page-in: grid.cells + 1 per
/// side, row by row from the south-west, NaN where there is none.
void fill_tile(const TerrainSource& source, const terrain::TileGrid& grid, const terrain::TileKey& key,
               std::span<float> height_m, std::span<std::uint8_t> sediment);

}  // namespace ensonify::source

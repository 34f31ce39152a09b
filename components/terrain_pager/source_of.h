#pragma once

#include <memory>

#include "components/terrain_pager/config.h"
#include "components/terrain_pager/terrain_source.h"
#include "messages/terrain.h"

namespace ensonify::pager {

/// Opens the scenario's terrain. Throws ConfigError on a user's mistake.
std::unique_ptr<TerrainSource> source_of(const TerrainPagerConfig& config);

/// Distance between posts of the tiles: the scenario's, or the raster's own cell size when that is smaller.
double post_spacing_m(const TerrainPagerConfig& config, const TerrainSource& terrain);

/// A tile of the set, its heights on the lattice.
msg::Tile make_tile(const TerrainSource& terrain, const terrain::TileGrid& grid, const terrain::TileKey& key);

/// The terrain at a glance: at most 256 x 256 posts.
msg::Chart make_chart(const TerrainSource& terrain);

}  // namespace ensonify::pager

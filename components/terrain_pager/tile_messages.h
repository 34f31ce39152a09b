#pragma once

#include "components/terrain/terrain_source.h"
#include "messages/terrain.h"

namespace ensonify::pager {

using source::Extent;
using source::TerrainSource;

/// A tile of the set, its heights on the lattice.
msg::Tile make_tile(const TerrainSource& terrain, const terrain::TileGrid& grid, const terrain::TileKey& key);

/// The terrain at a glance: its overview, at most 256 x 256 posts.
msg::Chart make_chart(const TerrainSource& terrain, const source::Overview& overview);

}  // namespace ensonify::pager

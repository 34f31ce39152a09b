#pragma once

#include <string>

#include "components/terrain/tiles/tile_set.h"

namespace ensonify::tiles {

/// Contents of a tile's sidecar and world file; the same facts give the same bytes.
std::string sidecar_text(const TileSet& set, const terrain::TileKey& key, const TileFacts& facts);
std::string world_file(const TileSet& set, const terrain::TileKey& key);

/// Contents of seabed.vrt: one virtual raster over all tiles, in metres.
std::string vrt_text(const TileSet& set);

}  // namespace ensonify::tiles

#pragma once

#include <string>

#include "components/terrain/tiles/tile_set.h"

/// Texts of a set's files; the same facts give the same bytes.
namespace ensonify::tiles {

inline constexpr const char* kTileFormat = "tile/1";

/// Of one tile, in the manifest (`between`: ", ") and in its sidecar (a line each).
std::string facts_text(const terrain::TileKey& key, const TileFacts& facts, const char* between);
std::string grid_text(const TileSet& set);

/// One virtual raster over all tiles, in metres: the contents of seabed.vrt.
std::string vrt_text(const TileSet& set);

std::string sidecar_text(const TileSet& set, const terrain::TileKey& key, const TileFacts& facts);
std::string world_file(const TileSet& set, const terrain::TileKey& key);

}  // namespace ensonify::tiles

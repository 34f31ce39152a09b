#pragma once

#include <string>
#include <vector>

#include "components/terrain/tiles/tile_set.h"

namespace ensonify::tiles {

/// Every fault of a set: missing or unreadable files, wrong checksums, sidecars and world files that contradict the
/// manifest, neighbours whose shared posts differ, an overview that is not that of the tiles. Empty: all is well.
std::vector<std::string> faults_of(const TileSet& set);

}  // namespace ensonify::tiles

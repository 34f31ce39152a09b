#pragma once

#include <string>

#include "components/terrain_pager/config.h"

namespace ensonify::pager {

/// All that decides what the tiles of a generated seabed hold, as text: the scenario's site, seed and seabed as they
/// were read, --set included; the files that its guides name (with those beside them that GDAL knows to belong to
/// them; a tile set's manifest, which has the checksums of its tiles); and program_identity(). Anything else of the
/// scenario, such as its mission, changes nothing.
std::string seabed_identity(const TerrainPagerConfig& config);

}  // namespace ensonify::pager

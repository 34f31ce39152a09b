#pragma once

#include "components/terrain/layered_seabed.h"
#include "kernels/base/frames/local_projection.h"

namespace ensonify::source {

/// Reads guides from their rasters and tile sets: heights on cells of the size asked for, over the seabed's rectangle
/// and a little more. `origin` is the world's. What it returns throws std::invalid_argument for tiles of another
/// origin, holes, or more than 64 million cells, and ConfigError for a file that cannot be read; it is good for as long
/// as `seabed` is.
GuideReader guide_files(const LayeredSeabed& seabed, const frames::Geodetic& origin);

}  // namespace ensonify::source

#pragma once

#include <vector>

#include "components/terrain/tiles/tile_set.h"

namespace ensonify::tiles {

/// Heights of a few posts all over a set, m, so that a chart of it need not read every tile; row by row from the
/// south-west, NaN where nothing is known. Which posts they are is the user's business
/// (components/terrain/terrain_source.h).
struct Overview {
  int columns = 0;  // to the east
  int rows = 0;     // to the north
  std::vector<float> height_m;
};

/// An array file of NumPy's, float32.
inline constexpr const char* kOverview = "overview.npy";

/// Writes the file and notes its checksum in `set`; it counts once the manifest is written. The checksum is that of the
/// tiles' checksums, the numbers of posts and the heights: an overview does not outlive its tiles. Throws TileError
/// when the disk refuses.
void write_overview(TileSet& set, const Overview& overview);

/// Throws TileError, naming the file, for one that is missing or is not the manifest's.
Overview read_overview(const TileSet& set);

}  // namespace ensonify::tiles

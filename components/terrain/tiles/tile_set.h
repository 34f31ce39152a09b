#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "components/terrain/tiles/file_bytes.h"
#include "kernels/base/frames/local_projection.h"
#include "kernels/mesh/tile.h"

/// Seabeds on disk (docs/manual/tiles.md): a folder of square tiles, each a 16-bit PNG of heights, an 8-bit PNG of
/// sediment classes, a world file and a sidecar, under one manifest. GDAL and QGIS read the tiles one by one, or all as
/// seabed.vrt.
///
/// All heights of a set are whole multiples of one step, lsb_m; a tile's PNG counts steps from a whole-numbered offset
/// of its own. Posts that two tiles share therefore have equal heights, to the bit. Value 0 is a hole.
namespace ensonify::tiles {

/// The folder's layout and words; a manifest of another major is refused.
inline constexpr const char* kFormat = "tiles/1";
inline constexpr const char* kManifest = "tileset.yaml";
inline constexpr std::int64_t kMostSteps = 65534;  // between the lowest and the highest post of a tile

/// Facts of a tile in a set's sidecar.
struct TileFacts {
  std::int64_t offset_steps = 0;  // height = (offset_steps + value) * lsb_m
  double lowest_m = 0.0;          // of the posts that are no holes; 0 where all are
  double highest_m = 0.0;
  std::int64_t holes = 0;  // posts
  std::string sha256;      // of size, offset, heights and classes, not of the files: another libpng changes nothing
  bool operator==(const TileFacts&) const = default;
};

struct TileSet {
  std::string folder;
  frames::Geodetic origin;  // of the world, which is the south-west corner of tile (0, 0)
  terrain::TileGrid grid;   // its origin_enu_m is zero
  std::string made_from;    // what the builder worked from, for people
  std::map<terrain::TileKey, TileFacts> tiles;
  std::string overview_sha256;  // of its overview; "": it has none

  std::string path_of(const terrain::TileKey& key, const std::string& ending) const;  // e.g. ".png"
};

/// Reads the manifest. Throws ConfigError for one that is missing, malformed, or of another major.
TileSet open_tile_set(const std::string& folder);

/// Writes a tile's four files, the sidecar last, so that a tile with a sidecar is whole; then no half file is ever seen
/// under its own name. Throws TileError when the tile spans more than kMostSteps, or when the disk refuses.
TileFacts write_tile(const TileSet& set, const terrain::TileKey& key, const terrain::Tile& tile);

/// The facts of a tile whose sidecar stands in the folder and fits the set; an empty checksum otherwise. For builds
/// that go on where they were stopped.
TileFacts facts_on_disk(const TileSet& set, const terrain::TileKey& key);

/// Heights and classes of a tile of the set. Throws TileError naming the file; the checksum is compared.
terrain::Tile read_tile(const TileSet& set, const terrain::TileKey& key);

/// Writes the manifest and seabed.vrt; the last act of a build.
void write_manifest(const TileSet& set);

}  // namespace ensonify::tiles

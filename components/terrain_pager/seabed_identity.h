#pragma once

#include <string>

#include "components/terrain_pager/config.h"

/// By what a cache knows that a result is still the one that would be computed now.
namespace ensonify::pager {

/// All that decides what the tiles of a generated seabed hold, as text: the scenario's site, seed and seabed as they
/// were read, --set included; the files that its guides name (with those beside them that GDAL knows to belong to
/// them; a tile set's manifest, which has the checksums of its tiles); and program_identity(). Anything else of the
/// scenario, such as its mission, changes nothing.
std::string seabed_identity(const TerrainPagerConfig& config);

/// All that decides what a pager makes of its seabed, for later epochs of the same process: the above with the files of
/// rasters, tile sets and meshes, and how rasters are read. Without the seed where nothing is drawn. "" without a
/// launch.
std::string resident_identity(const TerrainPagerConfig& config);

/// Path, size in bytes and time of the last change in ns, on a line; of a file that cannot be examined, its path
/// alone.
std::string file_identity(const std::string& path);

/// Build of this program and of its loaded libraries: a line for each, with the build ID that the
/// linker took from its contents (ELF note NT_GNU_BUILD_ID), or file_identity() where it left none. Equal lines mean
/// equal machine code, not equal processors.
std::string program_identity();

}  // namespace ensonify::pager

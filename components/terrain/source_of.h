#pragma once

#include <memory>
#include <optional>
#include <string>

#include "components/terrain/terrain_source.h"
#include "scenarios/world/world.h"

namespace ensonify::source {

/// Which seabed: the scenario's, and what its author left to those who open a raster.
struct TerrainOptions {
  Site site;
  Seabed seabed;
  std::string raster_crs;  // reference system of a raster that names none (or a wrong one)
  int raster_band = 1;
  std::optional<double> raster_nodata;  // mark for missing values of a raster that declares none
};

/// Opens the terrain. Throws ConfigError on a user's mistake.
std::unique_ptr<TerrainSource> source_of(const TerrainOptions& options);

/// Distance between posts: that of a tile set; else the scenario's, or the raster's own cell size when that is smaller.
double post_spacing_m(const TerrainOptions& options, const TerrainSource& terrain);

/// Step of the lattice of heights: that of a tile set; else the scenario's.
double lsb_m(const TerrainOptions& options, const TerrainSource& terrain);

}  // namespace ensonify::source

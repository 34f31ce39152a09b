#pragma once

#include <string>

#include "tools/terrain/import/options.h"
#include "tools/terrain/import/points.h"

namespace ensonify::terrain_import {

/// Makes cells of a mesh, OBJ or PLY, x to the east, y to the north: the highest of its surfaces over each cell's
/// middle; cells without are holes. What lies under another surface is lost; `widest_spread_m` is the farthest that it
/// lies below. All three axes are in the file's units (FileOptions::units, else metres). Writes a raster as
/// grid_points does.
PointFacts grid_mesh(const FileOptions& file, const PointOptions& options, const std::string& raster_path);

}  // namespace ensonify::terrain_import

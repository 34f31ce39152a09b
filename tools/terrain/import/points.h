#pragma once

#include <string>

#include "tools/terrain/import/options.h"

namespace ensonify::terrain_import {

/// Result of gridding scattered points.
struct PointFacts {
  std::int64_t points = 0;
  std::string method;
  double cell_m = 0.0;
  std::int64_t cells = 0;        // that got a value
  double widest_spread_m = 0.0;  // between the lowest and the highest point of one cell: overhangs, walls, outliers
};

/// True for a text of places and heights that is no regular grid, which GDAL's XYZ driver therefore refuses.
bool is_scattered(const std::string& path);

/// Makes cells of points: the mean, lowest or highest of those within a cell (cells without points are holes), or the
/// plane through the three points of Delaunay's triangle around a cell's centre [GDAL's gdal_grid, "linear"], nothing
/// beyond their hull. Writes a raster that GDAL can open at `raster_path` (in memory).
///
/// A line is x y z, with blanks, commas or semicolons between, more columns allowed and ignored; a first line that
/// starts with a letter is a header. Throws UserError with file and line for anything else.
PointFacts grid_points(const FileOptions& file, const PointOptions& options, const std::string& raster_path);

}  // namespace ensonify::terrain_import

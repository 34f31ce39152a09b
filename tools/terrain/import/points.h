#pragma once

#include <cstddef>
#include <string>
#include <vector>

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

/// Makes cells of a mesh, OBJ or PLY, x to the east, y to the north: the highest of its surfaces over each cell's
/// middle; cells without are holes. What lies under another surface is lost; `widest_spread_m` is the farthest that it
/// lies below. All three axes are in the file's units (FileOptions::units, else metres). Writes a raster as
/// grid_points does.
PointFacts grid_mesh(const FileOptions& file, const PointOptions& options, const std::string& raster_path);

/// Square cells over a rectangle of a map, row by row from the south; NaN at first.
struct CellGrid {
  double west = 0.0, south = 0.0;  // of the first cell's corner
  double cell = 1.0;               // side
  int columns = 0, rows = 0;
  std::vector<float> cells;

  /// Covers a rectangle. Throws UserError, beginning with `who`, when that takes more than kMostCells.
  CellGrid(const std::string& who, double west, double south, double east, double north, double cell);

  /// The cell that holds a place of the rectangle.
  std::size_t cell_at(double x, double y) const;
  /// As a GeoTIFF without a reference system, NaN for nodata. Throws UserError.
  void write(const std::string& path) const;
};

/// Cells of one raster and posts of one tile set that are held in memory, some 20 bytes each.
inline constexpr double kMostCells = 1e8;

}  // namespace ensonify::terrain_import

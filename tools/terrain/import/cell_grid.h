#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ensonify::terrain_import {

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

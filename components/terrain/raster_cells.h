#pragma once

#include <optional>
#include <vector>

#include "components/terrain/raster_file.h"

/// Values of a raster between its cells, by fractions of columns and rows.
namespace ensonify::source {

/// Bilinear between the four cells around a position; NaN if one that counts is a hole or outside the window.
double interpolate(const CellWindow& window, const std::vector<float>& elevation_m, double column, double row);

/// The value of the nearest cell; NaN outside the window.
double nearest(const CellWindow& window, const std::vector<float>& value, double column, double row);

/// The cells that some of these positions need: at least 2 x 2, or none when all are outside.
std::optional<CellWindow> window_around(const RasterFile& file, const std::vector<double>& column,
                                        const std::vector<double>& row);

}  // namespace ensonify::source

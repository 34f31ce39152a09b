#pragma once

#include <span>
#include <string>

namespace ensonify::source {

/// Fills the NaN of a raster, row by row, from what lies around them: inverse distance weights of the nearest values in
/// each quadrant [GDAL's GDALFillNodata], then `smoothing` passes of a 3 x 3 mean over what was filled. Cells farther
/// than `distance_cells` from any value stay NaN. Filled cells lie between the values that they came from.
///
/// Gives GDAL's complaint, or "" when all went well.
std::string fill_holes(std::span<float> cells, int columns, int rows, double distance_cells, int smoothing = 0);

}  // namespace ensonify::source

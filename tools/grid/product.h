#pragma once

#include <string>
#include <vector>

#include "kernels/survey/grid/soundings.h"

namespace ensonify::grid_tool {

/// What a grid's file says besides its numbers.
struct ProductFacts {
  std::string crs_wkt;               // of its map; "": nobody knows where it is
  std::string datum;                 // from which depths count
  std::vector<std::string> sources;  // files
  std::string version;               // of this program
};

/// Elevations, up, as five bands of float: weighted mean, shoalest, number of soundings, standard deviation,
/// uncertainty at 95 %. Cells without soundings stay open: NaN in all bands. Throws DataLost when it cannot be written,
/// UserError for a grid of more than 2 x 10^9 cells.
void write_geotiff(const std::string& file, const survey_grid::SoundingGrid& grid, const ProductFacts& facts);

/// Elevation (weighted mean) and uncertainty, at 95 %, as a Bathymetric Attributed Grid. It needs a map, and memory for
/// all cells: UserError without one, and for more than 3 x 10^8.
void write_bag(const std::string& file, const survey_grid::SoundingGrid& grid, const ProductFacts& facts);

}  // namespace ensonify::grid_tool

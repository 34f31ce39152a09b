#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kernels/survey/grid/soundings.h"
#include "tools/grid/input.h"
#include "tools/grid/product.h"

namespace ensonify::grid_tool {

struct GridOptions {
  std::optional<double> cell_m;  // not given: by the median depth of the first 20,000 soundings
  std::string crs;               // "": that of the first file
};

struct Gridded {
  survey_grid::SoundingGrid grid;
  ProductFacts facts;
  std::uint64_t left_out = 0;  // soundings that the grid's map does not reach, or without a position or a depth
};

/// Grids the soundings of all files. Throws UserError: files of different datums, with and without a position.
Gridded grid_of(const std::vector<std::unique_ptr<SoundingFile>>& files, const GridOptions& options);

/// A side of cells, m, for soundings of this depth: the largest of 0.1, 0.2, 0.5, 1, 2, 5, ... 100 that is 5 % of it or
/// less, and 0.1 where none is.
double cell_for_depth_m(double depth_m);

}  // namespace ensonify::grid_tool

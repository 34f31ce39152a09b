#pragma once

#include <span>
#include <vector>

#include "kernels/acoustics/label/image.h"
#include "kernels/acoustics/label/strips.h"

namespace ensonify::label {

/// Geometric masks: no pulse, no side lobes, no multipath.
struct Masks {
  std::vector<Run> own;    // of each body, in the order of body, row and sample: they may overlap
  std::vector<Run> layer;  // where several overlap that which sends most, then the lower number; by row and sample
};

/// A cell, row by sample, is a body's where its surface that nothing hides covers more than a tenth of the cell's
/// width. Rows are in the order of their cells, which do not overlap within a sector; strips that lie in a cell are to
/// be much narrower than it.
Masks find_masks(std::span<const Strip> strips, std::span<const std::vector<Point>> points, const Fineness& fineness,
                 std::span<const Row> rows, const echo::Sampling& sampling);

}  // namespace ensonify::label

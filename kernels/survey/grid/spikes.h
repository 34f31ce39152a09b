#pragma once

#include <vector>

#include "kernels/seabed/statistics/surface.h"

namespace ensonify::survey_grid {

using relief_statistics::Surface;

/// A single cell that stands out of its surroundings as no seabed does.
struct Spike {
  int column = 0, row = 0;
  double above_m = 0.0;  // the highest of its neighbours; or, negative, below the lowest
};

/// Cells that stand above the highest or below the lowest of their eight neighbours by more than `least_m`, and by more
/// than `scatters` times the scatter around them: 1.4826 times the median magnitude, over 15 x 15 cells, of the
/// difference between a cell and the median of its neighbours.
///
/// Steps, corners and ridges are none, for a cell of theirs has neighbours of its own height; nor is white noise at the
/// default of 6. What is wider than a cell is not found. Rows first. Throws std::invalid_argument for a surface whose
/// sizes disagree.
std::vector<Spike> spikes_of(const Surface& surface, double least_m = 0.1, double scatters = 6.0);

}  // namespace ensonify::survey_grid

#pragma once

#include <cstdint>
#include <vector>

#include "kernels/seabed/statistics/surface.h"

namespace ensonify::survey_grid {

using relief_statistics::Surface;

/// Posts without a height that hang together along rows and columns.
struct Hole {
  std::int64_t posts = 0;
  bool at_rim = false;          // touches the surface's rim: ground that was not surveyed rather than a hole
  double reach_spacings = 0.0;  // from its farthest post to the nearest post that has a height
  int column = 0, row = 0;      // its first post
};

struct Holes {
  std::vector<Hole> hole;             // by their first posts
  std::vector<std::int32_t> of_post;  // which hole; -1 for a post that has a height
};

/// Throws std::invalid_argument for a surface whose sizes disagree or that has no height at all.
Holes holes_of(const Surface& surface);

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

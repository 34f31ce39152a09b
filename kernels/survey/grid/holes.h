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

}  // namespace ensonify::survey_grid

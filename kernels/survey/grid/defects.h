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

/// Slope of the spectrum between two wave lengths, in cells: W ~ K^-exponent.
struct Octave {
  double from_cells = 0.0, to_cells = 0.0;
  double exponent = 0.0;
};

/// Down to which wave length a survey's grid shows the seabed rather than its gridding.
struct Band {
  std::vector<Octave> octaves;  // 2-4, 4-8, 8-16, 16-32 cells; empty where no 64 x 64 cells are without a hole
  double begins_cells = 2.0;    // shorter waves are smoothed away; 2, Nyquist's, where none are
};

/// Seabeds fall with exponents of 2.7 to 3.8, gridded surveys with 4.3 to 5.7 in their first one or two octaves
/// [measured on six public grids]. An octave steeper than 4.1 is counted as smoothed, from the finest on.
/// Throws std::invalid_argument for a surface whose sizes disagree.
Band band_of(const Surface& surface);

/// Takes out waves shorter than this: a Gaussian mean over what is known, which halves the power of waves of that
/// length (and leaves 84 % at twice, 6 % at half of it). Holes stay holes. Throws std::invalid_argument below 2 cells.
void remove_shorter_waves(Surface& surface, double cells);

}  // namespace ensonify::survey_grid

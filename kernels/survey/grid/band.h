#pragma once

#include <vector>

#include "kernels/seabed/statistics/surface.h"

namespace ensonify::survey_grid {

using relief_statistics::Surface;

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

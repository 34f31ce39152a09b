#pragma once

#include <cstdint>

#include "kernels/seabed/statistics/surface.h"

namespace ensonify::survey_grid {

using relief_statistics::Surface;

/// Straight parallel bands in a surface, as survey lines leave them (a wrong draft, sound speed or roll bias): what is
/// left of heights when they are averaged along 128 cells of one direction.
struct Stripes {
  bool found = false;
  double along_rad = 0.0;         // their direction, from the rows (columns rising) towards rising rows, 0..pi
  double sd_m = 0.0;              // of the heights that they add
  double spacing_spacings = 0.0;  // from band to band; 0 when they come at no regular distance
  double contrast = 0.0;          // variance of the means along them, over the median of all directions
};

/// Heights less the level of their surroundings (97 x 97 cells) are averaged along 128 cells in 90 directions, at some
/// 20,000 cells. One direction whose means vary four times as much as the median direction's makes stripes, if they add
/// 1 mm or more; isotropic relief reaches 2.
///
/// Sand ripples and dunes with long straight crests appear the same and are found too: whether they are seabed is for
/// the user to say. Nothing is found in fewer than 97 x 97 cells. Throws std::invalid_argument when sizes disagree.
Stripes stripes_of(const Surface& surface);

/// Takes from each height the mean, along 128 cells of the stripes' direction, of what stands out of the surroundings.
/// Everything longer than that along the stripes, and narrower than 97 cells across, goes with them. Cells nearer than
/// some 40 cells to unsurveyed ground on both sides have no surroundings to be compared with and stay as they are.
/// Gives the number of cells that were changed.
std::int64_t remove_stripes(Surface& surface, const Stripes& stripes);

}  // namespace ensonify::survey_grid

#pragma once

#include <cstdint>
#include <vector>

#include "kernels/base/frames/attitude.h"
#include "kernels/seabed/relief/window.h"

namespace ensonify::relief {

/// Heights of an imported or stored macro shape, on a lattice of its own.
struct Raster {
  int columns = 0;  // >= 2
  int rows = 0;     // >= 2
  double cell_m = 5.0;
  frames::Vec2 first_enu_m = frames::Vec2::Zero();  // of the south-west value, from the scenario's origin
  std::vector<float> value;                         // row by row from the south, each from the west
};

/// A surface through the raster's values: cubic B-splines [Unser1999], two continuous derivatives, so its slopes and
/// curvatures show no cells. Outside, the values of the edge go on. Throws std::invalid_argument if the sizes disagree
/// or a value is not finite (holes are filled, or cut, by whoever imports).
Field smooth_surface(const Raster& raster, double post_spacing_m);

}  // namespace ensonify::relief

#pragma once

#include <limits>
#include <vector>

#include "kernels/base/frames/attitude.h"
#include "kernels/seabed/relief/window.h"

namespace ensonify::relief {

/// Masks of a layer: fields of 0 (not) to 1 (wholly). Between, the smooth step 3 u^2 - 2 u^3.

/// 1 where the quantity lies between the limits, falling to 0 over `softness` (its unit) centred on each limit;
/// softness 0 is a sharp border. An infinite limit is none.
struct Band {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  double softness = 0.0;
};
Field in_band(Field quantity, const Band& band);

/// 1 - mask
Field outside(Field mask);

/// Slope of a height field, m per m, and its curvature, 1/m (mean of both principal ones; positive in hollows), by
/// central differences over nodes of `level` and smooth below. Finer relief does not count: choose the scale that the
/// mask shall see.
Field slope_of(Field height_m, double post_spacing_m, int level);
Field curvature_of(Field height_m, double post_spacing_m, int level);

/// 1 inside a closed polygon (at least three corners, ENU m from the scenario's origin, either way round), the border
/// softened over `softness_m`.
Field in_polygon(std::vector<frames::Vec2> corners_enu_m, double softness_m, double post_spacing_m);

}  // namespace ensonify::relief

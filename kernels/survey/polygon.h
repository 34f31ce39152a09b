#pragma once

#include <vector>

#include "kernels/vehicle/runlines/runline.h"

namespace ensonify::survey {

using runlines::Vec2;

/// Corners in order, either sense; the last is joined to the first, and may be the first given again.
using Polygon = std::vector<Vec2>;

/// Area of a simple polygon, >= 0.
double area_m2(const Polygon& polygon);

/// Throws std::invalid_argument for fewer than 3 corners, corners that all lie on one line, and sides that intersect
/// elsewhere than in the corner between them: what such an area holds is a matter of taste.
void check_simple(const Polygon& polygon);

}  // namespace ensonify::survey

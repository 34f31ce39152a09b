#pragma once

#include <functional>
#include <vector>

#include "kernels/survey/spacing.h"
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

using runlines::Runline;

/// Depth below the head at a place, m; NaN where it is not known.
using DepthAt = std::function<double(const Vec2& place_enu_m)>;

/// Layout of lines over an area.
struct LayRules {
  double heading_rad = 0.0;  // grid, of the first line; the survey goes on to starboard of it
  Swath swath;
  double shortest_line_m = 1.0;  // pieces of lines that are shorter are left out
  double row_m = 5.0;            // distance along lines at which the bottom is examined, > 0
};

/// Parallel lines over an area, run alternately up and down, each as far from the one before as the swath allows on the
/// bottom there. Where the area is concave a line may come in pieces. `depth` decides everything that `rules` do not:
/// a slope spreads the lines. It is asked over the rectangle along the lines that holds the area. Throws
/// std::invalid_argument for fewer than 3 corners, corners on one line, sides that cross or touch one another, depths
/// that are not known or not above 0, and more than 10000 lines.
std::vector<Runline> adapted_lines(const Polygon& area, const DepthAt& depth, const LayRules& rules);

/// The same with one distance between lines, the one that the shallowest place asks for.
std::vector<Runline> fixed_lines(const Polygon& area, const DepthAt& depth, const LayRules& rules);

/// The same with a distance that is given; less, so that all are alike and the first lies half of it from the edge.
std::vector<Runline> spaced_lines(const Polygon& area, double spacing_m, const LayRules& rules);

}  // namespace ensonify::survey

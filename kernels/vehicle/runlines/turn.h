#pragma once

#include <array>

#include "kernels/vehicle/runlines/runline.h"

namespace ensonify::runlines {

/// A place and the way one faces there.
struct Waypose {
  Vec2 position_enu_m = Vec2::Zero();
  double heading_rad = 0.0;  // grid
};

/// One piece of a path: an arc or a straight line.
struct Leg {
  Waypose start;
  double length_m = 0.0;
  double turn_per_m = 0.0;  // rad/m, positive to starboard, 0 on a straight line
};

/// A way from one place and heading to another that bends nowhere tighter than its radius.
struct Turn {
  std::array<Leg, 3> legs;

  double length_m() const;

  /// Place and heading after `along_m`; clamped to the ends.
  Waypose at(double along_m) const;
};

/// The shortest such way [Dubins1957]: two arcs joined by a line, or three arcs. Precondition: radius_m > 0.
Turn shortest_turn(const Waypose& from, const Waypose& to, double radius_m);

/// Line-of-sight heading (runline.h) about the path's tangent at `along_m`: on the path it is the path's own heading.
double follow_heading_rad(const Turn& turn, const Vec2& position_enu_m, double along_m, double lookahead_m);

/// The distance along the turn nearest to a place, sought between `from_m` and `from_m + window_m` in steps of
/// `step_m`.
double nearest_along_m(const Turn& turn, const Vec2& position_enu_m, double from_m, double window_m,
                       double step_m = 0.25);

}  // namespace ensonify::runlines

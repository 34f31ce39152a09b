#pragma once

#include <array>
#include <vector>

#include "kernels/base/frames/attitude.h"

/// Survey lines, the way along them, and the turns between them. Horizontal plane, ENU metres.
namespace ensonify::runlines {

using frames::Vec2;

/// A survey line, run from start to end.
struct Runline {
  Vec2 start_enu_m = Vec2::Zero();
  Vec2 end_enu_m = Vec2::Zero();
};

/// A place as seen from a line.
struct LinePosition {
  double along_m;        // from the start, negative before it
  double cross_track_m;  // positive to starboard of the line
};

double length_m(const Runline& line);
double heading_rad(const Runline& line);  // grid, [0, 2 pi)
Runline reversed(const Runline& line);

/// Precondition: the line has a length.
LinePosition line_position(const Runline& line, const Vec2& position_enu_m);

/// The point `along_m` from the start; beyond the ends on the line's extension.
Vec2 point_on(const Runline& line, double along_m);

/// `count` parallel lines about `centre`, neighbours `spacing_m` apart, run alternately along `heading_rad` and back
/// (lawnmower). The first line is the outermost to port of that heading.
std::vector<Runline> lawnmower(const Vec2& centre_enu_m, double heading_rad, double length_m, double spacing_m,
                               int count);

/// The line lengthened by the given run-in before its start and run-out after its end.
Runline extended(const Runline& line, double run_in_m, double run_out_m);

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

/// Heading that leads back to the path, at the point `lookahead_m` ahead on its tangent at `along_m` (line-of-sight
/// guidance [Fossen2011], ch. 10). On the path it is the path's own heading; a smaller lookahead steers harder.
double follow_heading_rad(const Turn& turn, const Vec2& position_enu_m, double along_m, double lookahead_m);

/// The distance along the turn nearest to a place, sought between `from_m` and `from_m + window_m` in steps of
/// `step_m`.
double nearest_along_m(const Turn& turn, const Vec2& position_enu_m, double from_m, double window_m,
                       double step_m = 0.25);

}  // namespace ensonify::runlines

#pragma once

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

/// Heading that leads back to the line: at the point `lookahead_m` ahead of the nearest point of the (infinite) line
/// (line-of-sight guidance [Fossen2011], ch. 10). Smaller lookahead steers harder.
double line_of_sight_heading_rad(const Runline& line, const Vec2& position_enu_m, double lookahead_m);

/// `count` parallel lines about `centre`, neighbours `spacing_m` apart, run alternately along `heading_rad` and back
/// (lawnmower). The first line is the outermost to port of that heading.
std::vector<Runline> lawnmower(const Vec2& centre_enu_m, double heading_rad, double length_m, double spacing_m,
                               int count);

/// The line lengthened by the given run-in before its start and run-out after its end.
Runline extended(const Runline& line, double run_in_m, double run_out_m);

}  // namespace ensonify::runlines

#pragma once

#include "kernels/vehicle/runlines/runline.h"

/// Guidance laws: along lines and circles, to a place, above the bottom. Values in, values out; whoever steers keeps
/// the small states.
namespace ensonify::guidance {

using frames::Vec2;

/// Law of holding a line: integral line of sight [Borhaug2008]. The course points at the place `lookahead_m` ahead on
/// the line, and further to the side the longer the vehicle has been off it:
///   course = line - atan((e + sigma y) / lookahead),  y' = lookahead e / ((e + sigma y)^2 + lookahead^2)
/// with e the distance to starboard. A steady current v_c across the line, or an error of the compass, leaves no
/// distance: y settles where sigma y / lookahead = v_c / sqrt(U^2 - v_c^2), for any v_c below the speed U.
struct LineGains {
  double lookahead_m = 20.0;      // > 0; smaller steers harder
  double integral_mps = 0.0;      // sigma, >= 0; 0: none
  double most_integral_s = 60.0;  // |y| goes no further: a vehicle that is held up does not wind up
};

/// Gains for a vehicle: at least 10 times the way it makes in `lag_s`, which is the time from measurement to obeying,
/// so that the loop is damped whatever the speed, and at least `least_lookahead_m`. Small distances obey e'' + (U/L) e'
/// + (U sigma/L^2) e = 0, so that sigma = U / (4 damping^2). speed_mps > 0, damping >= 1.
LineGains line_gains(double speed_mps, double lag_s, double least_lookahead_m, double damping = 2.0);

/// Angle to steer off the line's heading, to starboard.
double course_offset_rad(const LineGains& gains, double cross_track_m, double integral_s);

/// The integral y after `dt_s`.
double next_integral_s(const LineGains& gains, double cross_track_m, double integral_s, double dt_s);

}  // namespace ensonify::guidance

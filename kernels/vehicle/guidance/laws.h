#pragma once

#include "kernels/base/frames/attitude.h"
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

struct Circle {
  Vec2 centre_enu_m = Vec2::Zero();
  double radius_m = 10.0;  // > 0
  bool clockwise = true;   // seen from above: the centre lies to starboard
};

/// Distance outside the circle, negative inside.
double outside_m(const Circle& circle, const Vec2& position_enu_m);

/// Course that leads onto the circle and round it: the tangent, turned inwards by atan(gain d / radius) at the distance
/// d outside it ([Beard2012], ch. 10). Far away it points at the centre. gain > 0. At the centre itself: north.
double circle_course_rad(const Circle& circle, const Vec2& position_enu_m, double gain);

/// Angle about the centre that a move covers in the circle's sense, (-pi, pi]; summed over a track it gives the turns
/// made. 0 at the centre.
double swept_rad(const Circle& circle, const Vec2& from_enu_m, const Vec2& to_enu_m);

/// Learns how the water carries a vehicle, from its velocity over ground and its heading. Only what is across the
/// heading counts: a vehicle makes no way sideways, and how fast it goes ahead through the water it need not know. On
/// one heading the drift across it is learned with the time constant `settle_s`; headings that differ give the rest.
/// Sideslip in turns appears as drift: leave turns out.
Vec2 learn_drift(const Vec2& drift_enu_mps, const Vec2& velocity_enu_mps, double heading_rad, double dt_s,
                 double settle_s);

/// Learns the same from a vehicle that makes its speed through the water, both across the heading and along it: what is
/// left of the velocity over ground. For straight ways at a steady speed.
Vec2 learn_current(const Vec2& current_enu_mps, const Vec2& velocity_enu_mps, double heading_rad, double speed_mps,
                   double dt_s, double settle_s);

/// The heading that makes good a course at a speed through the water: it points upstream by asin(across / speed). A
/// drift across the course of more than 0.9 times the speed is taken for that much: the vehicle is carried off.
/// speed_mps >= 0; below 0.05 m/s the course itself.
double heading_for_course_rad(double course_rad, double speed_mps, const Vec2& drift_enu_mps);

/// The bottom under a vehicle as its altimeter gives it: depth, and how fast it rises or falls under way.
struct BottomTrack {
  bool known = false;
  double depth_m = 0.0;   // below the water level
  double rate_mps = 0.0;  // deeper is positive
};

/// The track after another reading, `dt_s` > 0 after the last one: own depth plus altitude, smoothed by the critically
/// damped g-h filter of the time constant `settle_s` > 0. A bottom of constant slope is followed without lag. The first
/// reading is accepted at once.
BottomTrack track_bottom(const BottomTrack& track, double depth_m, double altitude_m, double dt_s, double settle_s);

/// Rules for the depth to hold.
struct HeightRules {
  double altitude_m = 5.0;        // wanted above the bottom
  double least_altitude_m = 2.0;  // obstacle floor: nearer than this the vehicle climbs first of all
  double least_depth_m = 0.0;     // not above this
  double greatest_depth_m = 1e4;  // not below this
  double lookahead_s = 0.0;       // where the bottom rises, be as high now as it takes then; a falling one is awaited
};

struct HeightOrder {
  double depth_m = 0.0;  // to hold
  bool too_low = false;  // nearer to the bottom than the obstacle floor: climb, and do not go on until clear
};

/// The depth to hold above a tracked bottom, from the last reading of the altimeter and the vehicle's own depth. Too
/// low, it is the depth at which the floor would be kept, and as much again. An unknown bottom: the present depth.
HeightOrder follow_bottom(const HeightRules& rules, const BottomTrack& track, double depth_m, double altitude_m);

/// The same rules at a constant depth: as ordered, but never nearer to the bottom than the obstacle floor.
HeightOrder hold_depth(const HeightRules& rules, const BottomTrack& track, double ordered_m, double depth_m,
                       double altitude_m);

/// Highest speed from which a vehicle still stops within a distance: sqrt(2 a d), less what it covers in `lag_s` before
/// it obeys: the root of v^2 / (2 a) + v lag = d. distance_m >= 0, deceleration_mps2 > 0, lag_s >= 0.
double stopping_speed_mps(double distance_m, double deceleration_mps2, double lag_s);

/// Station keeping of a vehicle that only goes ahead: it turns towards where it should be and goes there, slower the
/// nearer it is; within `watch_radius_m` it goes just fast enough to stand against the drift, bow upstream.
struct StationRules {
  double watch_radius_m = 3.0;     // > 0
  double approach_ps = 0.2;        // speed over ground per metre outside the watch radius, > 0
  double fastest_mps = 1.0;        // through the water, > 0
  double deceleration_mps2 = 0.2;  // > 0
  double lag_s = 0.5;              // from measurement to obeying
};

struct Steering {
  double heading_rad = 0.0;  // grid
  double speed_mps = 0.0;    // through the water, ahead
};

/// `heading_rad` is the present one: kept where the vehicle has nothing to do. A vehicle whose bow is more than 90
/// degrees off the way it should go gets half the turning speed `fastest_mps / 2`: on the spot it could not turn.
Steering keep_station(const StationRules& rules, const Vec2& place_enu_m, const Vec2& position_enu_m,
                      double heading_rad, const Vec2& drift_enu_mps);

/// Slower water than this, m/s, is kept a place in from anywhere, faster water from downstream.
inline constexpr double kStream_mps = 0.1;

/// The last, straight way to a place in a stream: from so far downstream that a vehicle that comes off a turn lines up
/// in `settle_m` and then stops from `fastest_mps`, to the place. drift of kStream_mps or more.
runlines::Runline upstream_way(const StationRules& rules, double settle_m, const Vec2& place_enu_m,
                               const Vec2& drift_enu_mps);

/// Approach of a vehicle up that way, and its stand in the stream: its heading leads back to the way within about
/// `lookahead_m`, its speed to the place along it. Upstream of the place it falls back, with steerage. A heading that
/// never leaves upstream by much needs little turning, which a boat that stands over ground can do but slowly.
Steering stem(const StationRules& rules, double lookahead_m, const runlines::Runline& way, const Vec2& position_enu_m,
              const Vec2& drift_enu_mps);

}  // namespace ensonify::guidance

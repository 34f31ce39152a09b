#pragma once

#include "kernels/base/frames/attitude.h"
#include "kernels/vehicle/runlines/runline.h"

namespace ensonify::guidance {

using frames::Vec2;

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

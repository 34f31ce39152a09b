#pragma once

namespace ensonify::guidance {

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

}  // namespace ensonify::guidance

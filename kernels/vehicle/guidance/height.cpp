#include "kernels/vehicle/guidance/height.h"

#include <algorithm>
#include <cmath>

namespace ensonify::guidance {
namespace {

/// Where the highest bottom counts that will be reached within the time looked ahead.
double bottom_ahead_m(const HeightRules& rules, const BottomTrack& track) {
  return track.depth_m + std::min(0.0, track.rate_mps * rules.lookahead_s);
}

HeightOrder within(const HeightRules& rules, double wanted_m, double depth_m, double altitude_m) {
  const double short_m = rules.least_altitude_m - altitude_m;
  if (short_m > 0.0) return {std::max(rules.least_depth_m, depth_m - 2.0 * short_m), true};
  return {std::clamp(wanted_m, rules.least_depth_m, rules.greatest_depth_m), false};
}

}  // namespace

BottomTrack track_bottom(const BottomTrack& track, double depth_m, double altitude_m, double dt_s, double settle_s) {
  const double measured_m = depth_m + altitude_m;
  if (!track.known) return {true, measured_m, 0.0};
  const double fading = std::exp(-dt_s / settle_s), g = 1.0 - fading * fading, h = (1.0 - fading) * (1.0 - fading);
  const double expected_m = track.depth_m + track.rate_mps * dt_s, off_m = measured_m - expected_m;
  return {true, expected_m + g * off_m, track.rate_mps + h * off_m / dt_s};
}

HeightOrder follow_bottom(const HeightRules& rules, const BottomTrack& track, double depth_m, double altitude_m) {
  if (!track.known) return {depth_m, false};
  return within(rules, bottom_ahead_m(rules, track) - rules.altitude_m, depth_m, altitude_m);
}

HeightOrder hold_depth(const HeightRules& rules, const BottomTrack& track, double ordered_m, double depth_m,
                       double altitude_m) {
  if (!track.known) return {std::clamp(ordered_m, rules.least_depth_m, rules.greatest_depth_m), false};
  const double lowest_m = bottom_ahead_m(rules, track) - rules.least_altitude_m;
  return within(rules, std::min(ordered_m, lowest_m), depth_m, altitude_m);
}

}  // namespace ensonify::guidance

#include "kernels/vehicle/guidance/laws.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ensonify::guidance {
namespace {

/// Bearing of a place from the centre, clockwise from north.
double bearing_rad(const Circle& circle, const Vec2& position_enu_m) {
  const Vec2 off = position_enu_m - circle.centre_enu_m;
  return std::atan2(off.x(), off.y());
}

constexpr double kSteepest = 0.9;      // sine of the largest angle upstream
constexpr double kSlowest_mps = 0.05;  // slower than this no heading makes a course good

Vec2 forward(double heading_rad) { return {std::sin(heading_rad), std::cos(heading_rad)}; }
Vec2 starboard(double heading_rad) { return {std::cos(heading_rad), -std::sin(heading_rad)}; }

double sine_upstream(double course_rad, double speed_mps, const Vec2& drift_enu_mps) {
  if (speed_mps < kSlowest_mps) return 0.0;
  return std::clamp(drift_enu_mps.dot(starboard(course_rad)) / speed_mps, -kSteepest, kSteepest);
}

/// Where the highest bottom counts that will be reached within the time looked ahead.
double bottom_ahead_m(const HeightRules& rules, const BottomTrack& track) {
  return track.depth_m + std::min(0.0, track.rate_mps * rules.lookahead_s);
}

HeightOrder within(const HeightRules& rules, double wanted_m, double depth_m, double altitude_m) {
  const double short_m = rules.least_altitude_m - altitude_m;
  if (short_m > 0.0) return {std::max(rules.least_depth_m, depth_m - 2.0 * short_m), true};
  return {std::clamp(wanted_m, rules.least_depth_m, rules.greatest_depth_m), false};
}

constexpr double kStill_mps = 0.02;  // slower water than this is no drift
constexpr double kSteerage = 0.3;  // share of the stream's speed below which a vehicle that falls back would not steer

}  // namespace

LineGains line_gains(double speed_mps, double lag_s, double least_lookahead_m, double damping) {
  LineGains gains;
  gains.lookahead_m = std::max(least_lookahead_m, 10.0 * lag_s * speed_mps);
  gains.integral_mps = speed_mps / (4.0 * damping * damping);
  // Enough for a current of nine tenths of the speed: sigma y / lookahead = 0.9 / sqrt(1 - 0.9^2) = 2.06.
  gains.most_integral_s = 2.06 * gains.lookahead_m / gains.integral_mps;
  return gains;
}

double course_offset_rad(const LineGains& gains, double cross_track_m, double integral_s) {
  return -std::atan2(cross_track_m + gains.integral_mps * integral_s, gains.lookahead_m);
}

double next_integral_s(const LineGains& gains, double cross_track_m, double integral_s, double dt_s) {
  const double aim_m = cross_track_m + gains.integral_mps * integral_s;
  const double rate = gains.lookahead_m * cross_track_m / (aim_m * aim_m + gains.lookahead_m * gains.lookahead_m);
  return std::clamp(integral_s + rate * dt_s, -gains.most_integral_s, gains.most_integral_s);
}

double outside_m(const Circle& circle, const Vec2& position_enu_m) {
  return (position_enu_m - circle.centre_enu_m).norm() - circle.radius_m;
}

double circle_course_rad(const Circle& circle, const Vec2& position_enu_m, double gain) {
  if (position_enu_m == circle.centre_enu_m) return 0.0;
  const double side = circle.clockwise ? 1.0 : -1.0;
  const double inwards_rad = std::atan(gain * outside_m(circle, position_enu_m) / circle.radius_m);
  return frames::wrap_two_pi(bearing_rad(circle, position_enu_m) + side * (0.5 * std::numbers::pi + inwards_rad));
}

double swept_rad(const Circle& circle, const Vec2& from_enu_m, const Vec2& to_enu_m) {
  if (from_enu_m == circle.centre_enu_m || to_enu_m == circle.centre_enu_m) return 0.0;
  const double turned = frames::wrap_pi(bearing_rad(circle, to_enu_m) - bearing_rad(circle, from_enu_m));
  return circle.clockwise ? turned : -turned;
}

Vec2 learn_drift(const Vec2& drift_enu_mps, const Vec2& velocity_enu_mps, double heading_rad, double dt_s,
                 double settle_s) {
  const Vec2 across = starboard(heading_rad);
  const double missing_mps = across.dot(velocity_enu_mps - drift_enu_mps);
  return drift_enu_mps + (1.0 - std::exp(-dt_s / settle_s)) * missing_mps * across;
}

Vec2 learn_current(const Vec2& current_enu_mps, const Vec2& velocity_enu_mps, double heading_rad, double speed_mps,
                   double dt_s, double settle_s) {
  const Vec2 left_mps = velocity_enu_mps - speed_mps * forward(heading_rad);
  return current_enu_mps + (1.0 - std::exp(-dt_s / settle_s)) * (left_mps - current_enu_mps);
}

double heading_for_course_rad(double course_rad, double speed_mps, const Vec2& drift_enu_mps) {
  return frames::wrap_two_pi(course_rad - std::asin(sine_upstream(course_rad, speed_mps, drift_enu_mps)));
}

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

double stopping_speed_mps(double distance_m, double deceleration_mps2, double lag_s) {
  const double lost_mps = deceleration_mps2 * lag_s;
  return std::sqrt(lost_mps * lost_mps + 2.0 * deceleration_mps2 * distance_m) - lost_mps;
}

Steering keep_station(const StationRules& rules, const Vec2& place_enu_m, const Vec2& position_enu_m,
                      double heading_rad, const Vec2& drift_enu_mps) {
  const Vec2 way = place_enu_m - position_enu_m;
  const double outside_m = std::max(0.0, way.norm() - rules.watch_radius_m);
  Vec2 through_water = -drift_enu_mps;
  if (outside_m > 0.0) {
    const double ground_mps =
        std::min(rules.approach_ps * outside_m, stopping_speed_mps(outside_m, rules.deceleration_mps2, rules.lag_s));
    through_water += ground_mps * way.normalized();
  }
  if (through_water.norm() < kStill_mps) return {frames::wrap_two_pi(heading_rad), 0.0};
  const double wanted_rad = std::atan2(through_water.x(), through_water.y());
  const double off_rad = frames::wrap_pi(wanted_rad - heading_rad);
  const double speed_mps = std::min(through_water.norm(), rules.fastest_mps);
  return {frames::wrap_two_pi(wanted_rad),
          std::cos(off_rad) > 0.0 ? speed_mps : std::min(speed_mps, 0.5 * rules.fastest_mps)};
}

runlines::Runline upstream_way(const StationRules& rules, double settle_m, const Vec2& place_enu_m,
                               const Vec2& drift_enu_mps) {
  const double v = rules.fastest_mps;
  const double stopping_m = std::max(v * v / (2.0 * rules.deceleration_mps2) + v * rules.lag_s, v / rules.approach_ps);
  return {place_enu_m + (stopping_m + settle_m) * drift_enu_mps.normalized(), place_enu_m};
}

Steering stem(const StationRules& rules, double lookahead_m, const runlines::Runline& way, const Vec2& position_enu_m,
              const Vec2& drift_enu_mps) {
  const auto at = runlines::line_position(way, position_enu_m);
  const double to_go_m = runlines::length_m(way) - at.along_m;
  const double ground_mps = to_go_m > 0.0 ? std::min(rules.approach_ps * to_go_m,
                                                     stopping_speed_mps(to_go_m, rules.deceleration_mps2, rules.lag_s))
                                          : rules.approach_ps * to_go_m;
  const double stream_mps = drift_enu_mps.norm();
  const double off_rad = std::atan2(at.cross_track_m, lookahead_m);
  return {frames::wrap_two_pi(runlines::heading_rad(way) - off_rad),
          std::clamp((stream_mps + ground_mps) / std::cos(off_rad), kSteerage * stream_mps, rules.fastest_mps)};
}

}  // namespace ensonify::guidance

#include "kernels/vehicle/guidance/station.h"

#include <algorithm>
#include <cmath>

namespace ensonify::guidance {
namespace {

constexpr double kStill_mps = 0.02;  // slower water than this is no drift
constexpr double kSteerage = 0.3;  // share of the stream's speed below which a vehicle that falls back would not steer

}  // namespace

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

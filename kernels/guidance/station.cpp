#include "kernels/guidance/station.h"

#include <algorithm>
#include <cmath>

namespace ensonify::guidance {
namespace {

constexpr double kStill_mps = 0.02;  // slower water than this is no drift

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

}  // namespace ensonify::guidance

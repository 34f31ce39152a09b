#include "kernels/mesh/paging/prediction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <tuple>

namespace ensonify::paging {

Vec2 place_after(const Motion& motion, double time_s) {
  const double turned = motion.turn_rate_radps * time_s;
  // The chord of the arc: half of the turn away from the velocity, and shorter than the arc by sin(x)/x of it.
  const double half = 0.5 * turned;
  const double shorter = std::abs(half) < 1e-6 ? 1.0 : std::sin(half) / half;
  const double along = time_s * shorter * std::cos(half), left = time_s * shorter * std::sin(half);
  const Vec2& v = motion.velocity_enu_mps;
  return motion.position_enu_m + along * v + left * Vec2(-v.y(), v.x());
}

std::vector<Need> needs(const TileGrid& grid, const Box& terrain, const Motion& motion, const Horizon& horizon) {
  if (!(horizon.step_s > 0.0 && horizon.ahead_s >= 0.0 && horizon.wide_margin_m >= horizon.margin_m)) {
    throw std::invalid_argument("an outlook needs step_s > 0, ahead_s >= 0 and wide_margin_m >= margin_m");
  }
  std::map<TileKey, Need> of_tile;
  const auto steps = static_cast<int>(std::floor(horizon.ahead_s / horizon.step_s));
  for (int step = 0; step <= steps; ++step) {
    const double time_s = step * horizon.step_s;
    const Vec2 place = place_after(motion, time_s);
    for (const TileKey& key : tiles_near(grid, terrain, place, horizon.wide_margin_m)) {
      const double away_m = distance_m(box_of(grid, key), place);
      Need& need = of_tile.try_emplace(key, Need{key, std::numeric_limits<double>::infinity(), away_m}).first->second;
      need.distance_m = std::min(need.distance_m, away_m);
      if (away_m <= horizon.margin_m) need.due_s = std::min(need.due_s, time_s);
    }
  }
  std::vector<Need> all;
  all.reserve(of_tile.size());
  for (const auto& [key, need] : of_tile) all.push_back(need);
  std::ranges::sort(all, {}, [](const Need& need) { return std::tie(need.due_s, need.distance_m, need.key); });
  return all;
}

}  // namespace ensonify::paging

#include "kernels/mesh/paging/rules.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace ensonify::paging {

double distance_m(const Box& box, const Vec2& place) {
  const Vec2 outside = (box.low - place).cwiseMax(place - box.high).cwiseMax(0.0);
  return std::hypot(outside.x(), outside.y());
}

Box box_of(const TileGrid& grid, const TileKey& key) {
  const Vec2 low = grid.origin_of(key);
  return {low, low + Vec2::Constant(grid.side_m())};
}

std::vector<TileKey> tiles_near(const TileGrid& grid, const Box& terrain, const Vec2& place, double margin_m) {
  const Vec2 margin = Vec2::Constant(margin_m);
  const Vec2 low = (place - margin).cwiseMax(terrain.low);
  const Vec2 high = (place + margin).cwiseMin(terrain.high);
  if (low.x() > high.x() || low.y() > high.y()) return {};
  struct Near {
    double distance_m;
    TileKey key;
    auto operator<=>(const Near&) const = default;
  };
  std::vector<Near> near;
  const TileKey first = grid.key_at(low), last = grid.key_at(high);
  for (std::int32_t north = first.north; north <= last.north; ++north) {
    for (std::int32_t east = first.east; east <= last.east; ++east) {
      const double away_m = distance_m(box_of(grid, {east, north}), place);
      if (away_m <= margin_m) near.push_back({away_m, {east, north}});
    }
  }
  std::ranges::sort(near);
  std::vector<TileKey> keys;
  keys.reserve(near.size());
  for (const Near& tile : near) keys.push_back(tile.key);
  return keys;
}

std::size_t most_tiles_near(double side_m, double margin_m) {
  constexpr int kSteps = 16;
  const TileGrid grid{Vec2::Zero(), side_m, 1, 1.0};
  const double step_m = side_m / kSteps;
  const double reach_m = margin_m + 0.5 * std::hypot(step_m, step_m);
  const double far_m = reach_m + 2.0 * side_m;
  const Box endless{Vec2::Constant(-far_m), Vec2::Constant(far_m)};
  std::size_t most = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const Vec2 place((i + 0.5) * step_m, (j + 0.5) * step_m);
      most = std::max(most, tiles_near(grid, endless, place, reach_m).size());
    }
  }
  return most;
}

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

std::vector<TileKey> to_hold(std::span<const TileKey> needed, const LastWanted& held, std::size_t most) {
  std::vector<TileKey> keep;
  std::set<TileKey> kept;
  const auto add = [&](const TileKey& key) {
    if (keep.size() < most && kept.insert(key).second) keep.push_back(key);
  };
  for (const TileKey& key : needed) add(key);
  std::vector<std::pair<std::int64_t, TileKey>> rest;
  for (const auto& [key, last_used] : held) rest.emplace_back(-last_used, key);
  std::ranges::sort(rest);
  for (const auto& [age, key] : rest) add(key);
  return keep;
}

Exchange exchange(const TileGrid& grid, const Box& terrain, const Vec2& place, const Margins& margins,
                  std::span<const TileKey> held) {
  if (!(margins.release_m >= margins.feed_m)) throw std::invalid_argument("tiles are released beyond the feed margin");
  const std::set<TileKey> before(held.begin(), held.end());
  Exchange exchange;
  for (const TileKey& key : tiles_near(grid, terrain, place, margins.feed_m)) {
    if (!before.contains(key)) exchange.give.push_back(key);
  }
  for (const TileKey& key : before) {
    if (distance_m(box_of(grid, key), place) > margins.release_m) exchange.take.push_back(key);
  }
  return exchange;
}

}  // namespace ensonify::paging

#include "kernels/mesh/paging/near.h"

#include <algorithm>
#include <cmath>

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

}  // namespace ensonify::paging

#include "components/terrain_pager/paging.h"

#include <algorithm>
#include <cmath>

namespace ensonify::pager {

double Paging::distance_m(const TileKey& key, const Vec2& place) const {
  const Vec2 south_west = grid_.origin_of(key);
  const double side = grid_.side_m();
  const double east = std::max({south_west.x() - place.x(), 0.0, place.x() - south_west.x() - side});
  const double north = std::max({south_west.y() - place.y(), 0.0, place.y() - south_west.y() - side});
  return std::hypot(east, north);
}

std::vector<TileKey> Paging::within(const Vec2& place, double margin_m) const {
  const Vec2 margin(margin_m, margin_m);
  const Vec2 low = (place - margin).cwiseMax(Vec2(extent_.west_m, extent_.south_m));
  const Vec2 high = (place + margin).cwiseMin(Vec2(extent_.east_m, extent_.north_m));
  std::vector<TileKey> keys;
  if (low.x() > high.x() || low.y() > high.y()) return keys;
  const TileKey first = grid_.key_at(low), last = grid_.key_at(high);
  for (std::int32_t north = first.north; north <= last.north; ++north) {
    for (std::int32_t east = first.east; east <= last.east; ++east) {
      if (distance_m({east, north}, place) <= margin_m) keys.push_back({east, north});
    }
  }
  std::stable_sort(keys.begin(), keys.end(),
                   [&](const TileKey& a, const TileKey& b) { return distance_m(a, place) < distance_m(b, place); });
  return keys;
}

Paging::Decision Paging::decide(const Vec2& position, const Vec2& ahead) {
  Decision decision;
  for (const TileKey& key : within(position, margins_.feed_m)) {
    if (held_.insert(key).second) decision.publish.push_back(key);
  }
  for (auto it = held_.begin(); it != held_.end();) {
    const bool far = distance_m(*it, position) > margins_.release_m;
    if (far) decision.release.push_back(*it);
    it = far ? held_.erase(it) : std::next(it);
  }
  decision.keep_in_memory = within(ahead, margins_.load_m);
  return decision;
}

}  // namespace ensonify::pager

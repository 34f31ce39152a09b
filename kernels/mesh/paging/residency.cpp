#include "kernels/mesh/paging/residency.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

namespace ensonify::paging {

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

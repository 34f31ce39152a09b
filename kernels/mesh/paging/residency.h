#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "kernels/mesh/paging/near.h"

namespace ensonify::paging {

/// Last time that tiles lay within reach of the heads or were needed, in updates counted from the start.
using LastWanted = std::map<TileKey, std::int64_t>;

/// Which tiles memory is to hold now, at most `most`: those needed, in their order; then what it holds already, the
/// last wanted first (the least recently wanted are given up first), equally old ones by key. In order of importance.
std::vector<TileKey> to_hold(std::span<const TileKey> needed, const LastWanted& held, std::size_t most);

/// Rule for tiles that heads hold: tiles nearer than `feed_m` are given to them, those beyond `release_m`
/// taken away, and between the two all stays as it is, so that a vehicle at the border does not send tiles to and fro.
struct Margins {
  double feed_m = 100.0;
  double release_m = 150.0;  // at least feed_m
};
struct Exchange {
  std::vector<TileKey> give;  // nearest first
  std::vector<TileKey> take;  // by key
};
/// `held` are the keys that heads hold, in any order. Throws std::invalid_argument unless release_m >= feed_m.
Exchange exchange(const TileGrid& grid, const Box& terrain, const Vec2& place, const Margins& margins,
                  std::span<const TileKey> held);

}  // namespace ensonify::paging

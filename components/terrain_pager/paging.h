#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "kernels/mesh/paging/prediction.h"
#include "kernels/mesh/paging/residency.h"

namespace ensonify::pager {

using paging::Box;
using terrain::TileGrid;
using terrain::TileKey;

/// Decides which tiles heads hold and which of them memory is meant to hold: the rules of kernels/mesh/paging with what
/// they decided before. A function of the poses seen so far and of nothing else.
class Paging {
 public:
  struct Rules {
    paging::Margins margins;
    paging::Horizon horizon;
    std::size_t most = 100;  // tiles in memory
  };

  Paging(const TileGrid& grid, const Box& terrain, const Rules& rules)
      : grid_(grid), terrain_(terrain), rules_(rules) {}

  struct Decision {
    std::vector<TileKey> publish;    // nearest first
    std::vector<TileKey> release;    // by key
    std::vector<TileKey> in_memory;  // in order of importance, at most `most`
    int fetched = 0;                 // of these, not there at the update before
    int fetched_again = 0;           // of these, there at an earlier one
  };
  /// An update for where the vehicle is.
  Decision update(const paging::Motion& motion);

  /// Tiles to fetch before the first update when the vehicle will probably start there: those heads get at once. The
  /// rest may come while they ping.
  std::vector<TileKey> before_start(const paging::Vec2& place_enu_m) const;

 private:
  std::vector<TileKey> needed(const paging::Motion& motion, std::vector<TileKey> first) const;

  TileGrid grid_;
  Box terrain_;
  Rules rules_;
  std::int64_t updates_ = 0;
  std::set<TileKey> at_heads_;
  paging::LastWanted in_memory_;
  std::set<TileKey> ever_fetched_, ever_at_heads_;
};

}  // namespace ensonify::pager

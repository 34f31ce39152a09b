#pragma once

#include <set>
#include <vector>

#include "components/runtime/terrain/terrain_source.h"

namespace ensonify::pager {

using frames::Vec2;
using source::Extent;
using terrain::TileGrid;
using terrain::TileKey;

/// Distances from the vehicle, m, feed < release < load: heads hold what lies nearer than `feed`, keep it until it lies
/// beyond `release` (so that a vehicle circling at the border does not send tiles to and fro), and find it in memory
/// because everything nearer than `load` is fetched ahead.
struct Margins {
  double feed_m = 100.0;
  double release_m = 150.0;
  double load_m = 400.0;
};

/// Decides which tiles heads hold. A function of the poses seen so far and of nothing else.
class Paging {
 public:
  Paging(const TileGrid& grid, const Extent& extent, const Margins& margins)
      : grid_(grid), extent_(extent), margins_(margins) {}

  struct Decision {
    std::vector<TileKey> publish;  // nearest first
    std::vector<TileKey> release;
    std::vector<TileKey> keep_in_memory;  // nearest first, seen from where the vehicle will be
  };

  /// `ahead` is where the vehicle is expected when the next tiles are needed.
  Decision decide(const Vec2& position, const Vec2& ahead);

  /// Tiles of the terrain that come within `margin` of a place, nearest first, then by key.
  std::vector<TileKey> within(const Vec2& place, double margin_m) const;
  double distance_m(const TileKey& key, const Vec2& place) const;

 private:
  TileGrid grid_;
  Extent extent_;
  Margins margins_;
  std::set<TileKey> held_;
};

}  // namespace ensonify::pager

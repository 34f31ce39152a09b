#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "kernels/base/frames/attitude.h"

namespace ensonify::relief {

/// A rectangle of the world's lattice.
///
/// The world has one lattice of posts; post (east, north) lies at (east, north) * spacing from the scenario's origin.
/// The nodes of level k are every 2^k-th post. Values of a window are stored row by row from the south, each row from
/// the west, as in terrain::Tile.
struct Window {
  int level = 0;           // nodes are 2^level posts apart
  std::int64_t east = 0;   // the first node, counted in nodes of this level
  std::int64_t north = 0;  // "
  int columns = 0;         // > 0
  int rows = 0;            // > 0

  std::size_t size() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  std::size_t node(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
  bool operator==(const Window&) const = default;
};

/// Distance between the nodes of a level, m.
inline double node_spacing_m(double post_spacing_m, int level) {
  double spacing_m = post_spacing_m;
  for (int k = 0; k < level; ++k) spacing_m *= 2.0;
  for (int k = 0; k > level; --k) spacing_m *= 0.5;
  return spacing_m;
}

/// A quantity over the seabed: writes its value at every node of a window.
///
/// Pure: the value of a node is the same in every window of that level that holds it, on any thread. At level 0 it is
/// the quantity itself; at level k a field with finer detail may leave out what level k cannot show (each field says).
using Field = std::function<void(const Window& window, std::span<float> out)>;

/// Position of a node, ENU m from the scenario's origin. Computed from the post's number, so it is the same for every
/// window and level.
inline frames::Vec2 place_enu_m(const Window& window, int column, int row, double post_spacing_m) {
  const auto scale = static_cast<double>(std::int64_t{1} << window.level);
  return {static_cast<double>(window.east + column) * scale * post_spacing_m,
          static_cast<double>(window.north + row) * scale * post_spacing_m};
}

/// Share along a segment of its nearest point: 0 at a, 1 at b.
inline double along_segment(const frames::Vec2& place, const frames::Vec2& a, const frames::Vec2& b) {
  const double length2 = (b - a).squaredNorm();
  return length2 > 0.0 ? std::clamp((place - a).dot(b - a) / length2, 0.0, 1.0) : 0.0;
}

inline double distance2_to_segment(const frames::Vec2& place, const frames::Vec2& a, const frames::Vec2& b) {
  return (place - a - along_segment(place, a, b) * (b - a)).squaredNorm();
}

}  // namespace ensonify::relief

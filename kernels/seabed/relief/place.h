#pragma once

#include <algorithm>

#include "kernels/base/frames/attitude.h"
#include "kernels/seabed/relief/window.h"

namespace ensonify::relief {

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

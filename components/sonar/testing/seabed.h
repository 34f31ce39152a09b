#pragma once

#include <cmath>

#include "messages/terrain.h"

namespace ensonify {

/// For tests of heads: a square of seabed about the origin, `side_m` wide, of a height that depends on east and north.
template <class Height>
msg::Tile tile_of(double side_m, double spacing_m, const Height& height) {
  const auto posts = static_cast<std::size_t>(std::lround(side_m / spacing_m)) + 1;
  msg::Tile tile;
  tile.origin_east_m = tile.origin_north_m = -0.5 * side_m;
  tile.spacing_m = spacing_m;
  tile.height_m = msg::Array<float>({posts, posts});
  tile.sediment = msg::Array<std::uint8_t>({posts, posts});
  for (std::size_t row = 0; row < posts; ++row) {
    for (std::size_t col = 0; col < posts; ++col) {
      const double east = -0.5 * side_m + spacing_m * static_cast<double>(col);
      const double north = -0.5 * side_m + spacing_m * static_cast<double>(row);
      tile.height_m(row, col) = static_cast<float>(height(east, north));
    }
  }
  return tile;
}

}  // namespace ensonify

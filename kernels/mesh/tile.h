#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "kernels/base/frames/attitude.h"

namespace ensonify::terrain {

using frames::Vec2;
using frames::Vec3;

/// Which tile of a regular set: column to the east, row to the north, from the set's origin.
struct TileKey {
  std::int32_t east = 0;
  std::int32_t north = 0;
  auto operator<=>(const TileKey&) const = default;
};

/// A rectangle of seabed heights on a square lattice of posts.
///
/// Posts are stored row by row from the south, each row from the west; the first is at `origin_enu_m` (the tile's false
/// origin, its south-west corner). Heights are ENU z, up, in metres; NaN is a hole. Neighbouring tiles share edge
/// posts.
struct Tile {
  Vec2 origin_enu_m = Vec2::Zero();
  double spacing_m = 1.0;
  std::int32_t columns = 0;  // posts to the east, >= 2
  std::int32_t rows = 0;     // posts to the north, >= 2
  std::vector<float> height_m;
  std::vector<std::uint8_t> sediment;  // class per post; empty: all are `everywhere`
  std::uint8_t everywhere = 0;

  std::size_t post(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
  Vec3 position_enu_m(std::int32_t column, std::int32_t row) const {
    return {origin_enu_m.x() + column * spacing_m, origin_enu_m.y() + row * spacing_m, height_m[post(column, row)]};
  }
};

/// Fault of a tile's sizes, or nothing.
std::optional<const char*> fault_of(const Tile& tile);

/// Height (ENU z, m) between the posts, bilinear. Empty outside the tile and in cells that touch a hole.
std::optional<double> height_m(const Tile& tile, const Vec2& place_enu_m);

/// Unit normal, up, of the same bilinear surface.
std::optional<Vec3> normal_enu(const Tile& tile, const Vec2& place_enu_m);

/// Class of the nearest post; 0 outside.
std::uint8_t sediment_at(const Tile& tile, const Vec2& place_enu_m);

/// A regular set of tiles over a plane of posts.
struct TileGrid {
  Vec2 origin_enu_m = Vec2::Zero();  // of tile (0, 0)
  double spacing_m = 0.25;
  std::int32_t cells = 1024;  // per side of a tile; a tile has one post more
  double lsb_m = 1e-4;        // heights are whole multiples of this: one lattice for the whole set

  double side_m() const { return cells * spacing_m; }
  TileKey key_at(const Vec2& place_enu_m) const;
  Vec2 origin_of(const TileKey& key) const;
};

/// A height rounded to the lattice. Neighbours that round the same number get the same bits. NaN stays NaN.
float on_lattice(double height_m, double lsb_m);

/// The tile of a set, sampled from functions of place. Each place is computed from its whole-numbered post in the set,
/// so the posts that two tiles share get the same bits.
Tile sample_tile(const TileGrid& grid, const TileKey& key, const std::function<double(double, double)>& height_m_at,
                 const std::function<std::uint8_t(double, double)>& class_at = nullptr);

}  // namespace ensonify::terrain

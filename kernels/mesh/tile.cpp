#include "kernels/mesh/tile.h"

#include <algorithm>
#include <cmath>

namespace ensonify::terrain {
namespace {

/// The cell under a place and the heights of its corners.
struct Cell {
  std::int32_t column, row;
  double u, v;  // place within the cell, 0..1 to east and north
  double south_west, south_east, north_west, north_east;
};

std::optional<Cell> cell_at(const Tile& tile, const Vec2& place_enu_m) {
  const Vec2 posts = (place_enu_m - tile.origin_enu_m) / tile.spacing_m;
  if (!(posts.x() >= 0.0 && posts.y() >= 0.0 && posts.x() <= tile.columns - 1 && posts.y() <= tile.rows - 1)) {
    return std::nullopt;
  }
  const auto column = std::min(static_cast<std::int32_t>(posts.x()), tile.columns - 2);
  const auto row = std::min(static_cast<std::int32_t>(posts.y()), tile.rows - 2);
  const Cell cell{column,
                  row,
                  posts.x() - column,
                  posts.y() - row,
                  tile.height_m[tile.post(column, row)],
                  tile.height_m[tile.post(column + 1, row)],
                  tile.height_m[tile.post(column, row + 1)],
                  tile.height_m[tile.post(column + 1, row + 1)]};
  if (std::isnan(cell.south_west + cell.south_east + cell.north_west + cell.north_east)) return std::nullopt;
  return cell;
}

}  // namespace

std::optional<const char*> fault_of(const Tile& tile) {
  if (tile.columns < 2 || tile.rows < 2) return "a tile needs at least 2 x 2 posts";
  if (!(tile.spacing_m > 0.0)) return "the spacing of posts must be positive";
  const std::size_t posts = static_cast<std::size_t>(tile.columns) * static_cast<std::size_t>(tile.rows);
  if (tile.height_m.size() != posts) return "the number of heights is not columns x rows";
  if (!tile.sediment.empty() && tile.sediment.size() != posts) return "the number of classes is not columns x rows";
  return std::nullopt;
}

std::optional<double> height_m(const Tile& tile, const Vec2& place_enu_m) {
  const auto cell = cell_at(tile, place_enu_m);
  if (!cell) return std::nullopt;
  const double south = cell->south_west + cell->u * (cell->south_east - cell->south_west);
  const double north = cell->north_west + cell->u * (cell->north_east - cell->north_west);
  return south + cell->v * (north - south);
}

std::optional<Vec3> normal_enu(const Tile& tile, const Vec2& place_enu_m) {
  const auto cell = cell_at(tile, place_enu_m);
  if (!cell) return std::nullopt;
  const double rise_east =
      (1.0 - cell->v) * (cell->south_east - cell->south_west) + cell->v * (cell->north_east - cell->north_west);
  const double rise_north =
      (1.0 - cell->u) * (cell->north_west - cell->south_west) + cell->u * (cell->north_east - cell->south_east);
  return Vec3(-rise_east, -rise_north, tile.spacing_m).normalized();
}

std::uint8_t sediment_at(const Tile& tile, const Vec2& place_enu_m) {
  if (tile.sediment.empty()) return tile.everywhere;
  const Vec2 posts = (place_enu_m - tile.origin_enu_m) / tile.spacing_m;
  const double column = std::floor(posts.x() + 0.5), row = std::floor(posts.y() + 0.5);
  if (!(column >= 0.0 && row >= 0.0 && column < tile.columns && row < tile.rows)) return 0;
  return tile.sediment[tile.post(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row))];
}

TileKey TileGrid::key_at(const Vec2& place_enu_m) const {
  const Vec2 tiles = (place_enu_m - origin_enu_m) / side_m();
  return {static_cast<std::int32_t>(std::floor(tiles.x())), static_cast<std::int32_t>(std::floor(tiles.y()))};
}

Vec2 TileGrid::origin_of(const TileKey& key) const {
  return origin_enu_m + spacing_m * Vec2(static_cast<double>(key.east) * cells, static_cast<double>(key.north) * cells);
}

float on_lattice(double height_m, double lsb_m) { return static_cast<float>(std::round(height_m / lsb_m) * lsb_m); }

Tile sample_tile(const TileGrid& grid, const TileKey& key, const std::function<double(double, double)>& height_m_at,
                 const std::function<std::uint8_t(double, double)>& class_at) {
  Tile tile{grid.origin_of(key), grid.spacing_m, grid.cells + 1, grid.cells + 1, {}, {}};
  const std::size_t posts = static_cast<std::size_t>(tile.columns) * static_cast<std::size_t>(tile.rows);
  tile.height_m.reserve(posts);
  if (class_at) tile.sediment.reserve(posts);
  for (std::int32_t row = 0; row < tile.rows; ++row) {
    const double north = static_cast<double>(key.north) * grid.cells + row;
    const double y = grid.origin_enu_m.y() + north * grid.spacing_m;
    for (std::int32_t column = 0; column < tile.columns; ++column) {
      const double east = static_cast<double>(key.east) * grid.cells + column;
      const double x = grid.origin_enu_m.x() + east * grid.spacing_m;
      tile.height_m.push_back(on_lattice(height_m_at(x, y), grid.lsb_m));
      if (class_at) tile.sediment.push_back(class_at(x, y));
    }
  }
  return tile;
}

}  // namespace ensonify::terrain

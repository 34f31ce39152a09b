#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/trace/scene_impl.h"

namespace ensonify::trace {
namespace {

constexpr std::int32_t kSmallTileCells = 64;  // a side: all of it is one box
constexpr std::int32_t kObjectCells = 16;     // of a box around what stands among holes

bool whole_cell(const terrain::Tile& tile, std::int32_t column, std::int32_t row) {
  for (const auto& [c, r] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
    if (!std::isfinite(tile.height_m[tile.post(column + c, row + r)])) return false;
  }
  return true;
}

/// A box around the whole cells of [column, column + width) x [row, row + height), within the tile; none without such.
/// It is there only where a cell in or around the block is a hole, or where `all` of them are wanted.
void add_object(const terrain::Tile& tile, std::int32_t column, std::int32_t row, std::int32_t side, bool all,
                std::vector<Object>& objects) {
  Object object{
      {}, nullptr, 0, column, row, std::min(column + side, tile.columns - 1), std::min(row + side, tile.rows - 1)};
  bool holes = all;
  for (std::int32_t r = std::max(row - 1, 0); r < std::min(row + side + 1, tile.rows - 1); ++r) {
    for (std::int32_t c = std::max(column - 1, 0); c < std::min(column + side + 1, tile.columns - 1); ++c) {
      const bool inside = row <= r && r < row + side && column <= c && c < column + side;
      if (!whole_cell(tile, c, r)) {
        holes = true;
      } else if (inside) {
        for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
          object.box_enu_m.extend(tile.position_enu_m(c + x, r + y));
        }
      }
    }
  }
  if (holes && !object.box_enu_m.isEmpty()) objects.push_back(object);
}

}  // namespace

bool is_small(const terrain::Tile& tile) { return std::max(tile.columns, tile.rows) <= kSmallTileCells; }

std::vector<Object> objects_of(const terrain::Tile& tile) {
  std::vector<Object> objects;
  if (is_small(tile)) {
    add_object(tile, 0, 0, kSmallTileCells, true, objects);
  } else if (!std::all_of(tile.height_m.begin(), tile.height_m.end(), [](float z) { return std::isfinite(z); })) {
    for (std::int32_t row = 0; row < tile.rows - 1; row += kObjectCells) {
      for (std::int32_t column = 0; column < tile.columns - 1; column += kObjectCells) {
        add_object(tile, column, row, kObjectCells, false, objects);
      }
    }
  }
  return objects;
}

void Scene::Impl::gather_objects() {
  objects.clear();
  for (const auto& [key, entry] : tiles) {
    for (Object object : entry.objects) {
      object.tile = &entry.tile;
      object.number = entry.number;
      objects.push_back(object);
    }
  }
}

}  // namespace ensonify::trace

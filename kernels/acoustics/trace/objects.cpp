#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "kernels/acoustics/trace/scene_impl.h"

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

/// Examines all posts: so there is no branch in the loop.
bool has_hole(std::span<const float> height_m) {
  int holes = 0;
  for (const float z : height_m) holes |= std::abs(z) <= std::numeric_limits<float>::max() ? 0 : 1;
  return holes != 0;
}

/// Cells of a tile, from the first to before the end.
struct Cells {
  std::int32_t first_column, first_row, end_column, end_row;
};

/// Whether one of the posts of these cells is a hole.
bool touch_hole(const terrain::Tile& tile, const Cells& cells) {
  for (std::int32_t row = cells.first_row; row <= cells.end_row; ++row) {
    const std::int32_t posts = cells.end_column - cells.first_column + 1;
    const std::size_t first = tile.post(cells.first_column, row);
    if (has_hole(std::span(tile.height_m).subspan(first, static_cast<std::size_t>(posts)))) return true;
  }
  return false;
}

/// A box around the whole cells of a square block, within the tile; none without such. It is there only where a cell in
/// or around the block is a hole, or where `all` of them are wanted.
void add_object(const terrain::Tile& tile, std::int32_t column, std::int32_t row, std::int32_t side, bool all,
                std::vector<Object>& objects) {
  const auto end = [side](std::int32_t first, std::int32_t posts) { return std::min(first + side, posts - 1); };
  const Cells block{column, row, end(column, tile.columns), end(row, tile.rows)};
  const Cells around{std::max(block.first_column - 1, 0), std::max(block.first_row - 1, 0),
                     std::min(block.end_column + 1, tile.columns - 1), std::min(block.end_row + 1, tile.rows - 1)};
  if (!all && !touch_hole(tile, around)) return;
  Object object{{}, nullptr, 0, block.first_column, block.first_row, block.end_column, block.end_row};
  for (std::int32_t r = block.first_row; r < block.end_row; ++r) {
    for (std::int32_t c = block.first_column; c < block.end_column; ++c) {
      if (!whole_cell(tile, c, r)) continue;
      for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
        object.box_enu_m.extend(tile.position_enu_m(c + x, r + y));
    }
  }
  if (!object.box_enu_m.isEmpty()) objects.push_back(object);
}

}  // namespace

bool is_small(const terrain::Tile& tile) { return std::max(tile.columns, tile.rows) <= kSmallTileCells; }

std::vector<Object> objects_of(const terrain::Tile& tile) {
  std::vector<Object> objects;
  if (is_small(tile)) {
    add_object(tile, 0, 0, kSmallTileCells, true, objects);
  } else if (has_hole(tile.height_m)) {
    for (std::int32_t row = 0; row < tile.rows - 1; row += kObjectCells) {
      for (std::int32_t column = 0; column < tile.columns - 1; column += kObjectCells) {
        add_object(tile, column, row, kObjectCells, false, objects);
      }
    }
  }
  return objects;
}

void Scene::Impl::gather_objects() {
  auto all = std::make_shared<std::vector<Object>>();
  for (const auto& [key, entry] : tiles) {
    for (Object object : entry.objects) {
      object.tile = &entry.ground->tile;
      object.number = entry.number;
      all->push_back(object);
    }
  }
  objects = std::move(all);
}

}  // namespace ensonify::trace

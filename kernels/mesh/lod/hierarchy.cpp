#include "kernels/mesh/lod/hierarchy.h"

#include <algorithm>
#include <array>
#include <limits>

namespace ensonify::lod {
namespace {

using terrain::Vec3;

constexpr double kSlack_m = 0.01;
constexpr std::int32_t kFewestCells = 3;

std::int32_t blocks_over(std::int32_t cells, std::int32_t size) {
  return (cells + span_cells(size) - 1) / span_cells(size);
}

std::int32_t cells_between(std::int32_t first, std::int32_t last, std::int32_t level) {
  return (last - first + (1 << level) - 1) >> level;
}

}  // namespace

/// By columns, so that the loop over a row has no order to keep.
Hierarchy::Bounds Hierarchy::bounds_under(const terrain::Tile& tile, const Posts& under) {
  std::array<float, span_cells(0) + 1> lowest, highest;
  lowest.fill(std::numeric_limits<float>::infinity());
  highest.fill(-std::numeric_limits<float>::infinity());
  const std::int32_t width = under.east - under.west + 1;
  const auto columns = static_cast<std::size_t>(width);
  for (std::int32_t y = under.south; y <= under.north; ++y) {
    const float* height_m = tile.height_m.data() + tile.post(under.west, y);
    for (std::size_t x = 0; x < columns; ++x) {  // comparisons with a hole are false
      lowest[x] = height_m[x] < lowest[x] ? height_m[x] : lowest[x];
      highest[x] = height_m[x] > highest[x] ? height_m[x] : highest[x];
    }
  }
  return {*std::ranges::min_element(lowest), *std::ranges::max_element(highest)};
}

Hierarchy::Hierarchy(const terrain::Tile& tile)
    : origin_enu_m_(tile.origin_enu_m),
      spacing_m_(tile.spacing_m),
      last_column_(tile.columns - 1),
      last_row_(tile.rows - 1) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (std::int32_t size = 0; size <= kLargest; ++size) {
    const std::int32_t columns = blocks_over(last_column_, size), rows = blocks_over(last_row_, size);
    sizes_.push_back({columns, rows, {}});
    auto& all = sizes_.back().bounds;
    all.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), {kInfinity, -kInfinity});
  }
  for (std::int32_t row = 0; row < rows(0); ++row) {
    for (std::int32_t column = 0; column < columns(0); ++column) {
      const auto [lowest, highest] = bounds_under(tile, posts({0, column, row}));
      for (std::int32_t size = 0; size <= kLargest; ++size) {
        Size& of = sizes_[static_cast<std::size_t>(size)];
        const std::int32_t place = (row >> size) * of.columns + (column >> size);
        Bounds& all = of.bounds[static_cast<std::size_t>(place)];
        all = {std::min(all.lowest_m, lowest), std::max(all.highest_m, highest)};
      }
    }
  }
}

Posts Hierarchy::posts(const Block& block) const {
  const std::int32_t span = span_cells(block.size);
  return {block.column * span, std::min((block.column + 1) * span, last_column_), block.row * span,
          std::min((block.row + 1) * span, last_row_)};
}

const Hierarchy::Bounds& Hierarchy::bounds(const Block& block) const {
  const Size& size = sizes_[static_cast<std::size_t>(block.size)];
  const std::int32_t place = block.row * size.columns + block.column;
  return size.bounds[static_cast<std::size_t>(place)];
}

std::array<Vec3, 2> Hierarchy::box_enu_m(const Block& block) const {
  const Posts under = posts(block);
  const Bounds& heights = bounds(block);
  return {Vec3(origin_enu_m_.x() + spacing_m_ * under.west, origin_enu_m_.y() + spacing_m_ * under.south,
               static_cast<double>(heights.lowest_m)),
          Vec3(origin_enu_m_.x() + spacing_m_ * under.east, origin_enu_m_.y() + spacing_m_ * under.north,
               static_cast<double>(heights.highest_m))};
}

Sphere Hierarchy::sphere(const Block& block) const {
  const auto [low, high] = box_enu_m(block);
  return {0.5 * (low + high), 0.5 * (high - low).norm() + kSlack_m};
}

bool Hierarchy::has_room(const Leaf& leaf) const {
  const Posts under = posts(leaf.block);
  return leaf.level == 0 || (cells_between(under.west, under.east, leaf.level) >= kFewestCells &&
                             cells_between(under.south, under.north, leaf.level) >= kFewestCells);
}

}  // namespace ensonify::lod

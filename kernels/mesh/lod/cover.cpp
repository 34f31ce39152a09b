#include "kernels/mesh/lod/cover.h"

#include <algorithm>
#include <numeric>

namespace ensonify::lod {
namespace {

/// The greatest size of a block that a view intersects. Smaller ones make more blocks, whose neighbours change as the
/// view moves; of larger ones much is built that the view does not examine.
constexpr std::int32_t kLargestInView = 1;

}  // namespace

struct Cover::PreparedView {
  PreparedFrustum frustum;
  std::int32_t level;
};

void Cover::choose(const Hierarchy& hierarchy, std::span<const View> wanted) {
  clear(hierarchy);
  std::vector<PreparedView> views;
  for (const View& view : wanted) views.push_back({PreparedFrustum(view.frustum), view.level});
  for (std::int32_t row = 0; row < hierarchy.rows(kLargest); ++row) {
    for (std::int32_t column = 0; column < hierarchy.columns(kLargest); ++column) {
      views_in_reach_.resize(views.size());
      std::iota(views_in_reach_.begin(), views_in_reach_.end(), std::size_t{0});
      cover(hierarchy, views, 0, {kLargest, column, row});
    }
  }
}

void Cover::choose_all(const Hierarchy& hierarchy) {
  clear(hierarchy);
  for (std::int32_t row = 0; row < hierarchy.rows(kLargest); ++row) {
    for (std::int32_t column = 0; column < hierarchy.columns(kLargest); ++column) {
      const Block block{kLargest, column, row};
      if (!hierarchy.empty(block)) add({block, 0});
    }
  }
}

void Cover::clear(const Hierarchy& hierarchy) {
  columns_ = hierarchy.columns(0);
  rows_ = hierarchy.rows(0);
  leaves_.clear();
  levels_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), kNone);
}

/// The views that the block above has hit are numbered in `views_in_reach_`, from `first` on; those that this one hits,
/// or may hit, are added for the blocks below it.
void Cover::cover(const Hierarchy& hierarchy, std::span<const PreparedView> views, std::size_t first,
                  const Block& block) {
  if (hierarchy.empty(block)) return;
  const Sphere sphere = hierarchy.sphere(block);
  const std::size_t end = views_in_reach_.size();
  std::int32_t level = kCoarsest;
  for (std::size_t i = first; i < end; ++i) {
    const PreparedView& view = views[views_in_reach_[i]];
    const bool matters = view.level < level;
    if (matters && !view.frustum.intersects(sphere)) continue;
    if (matters) level = view.level;
    views_in_reach_.push_back(views_in_reach_[i]);
  }
  const std::int32_t size = block.size;
  const std::int32_t largest = level == kCoarsest ? kLargest : kLargestInView;
  if (size > 0 && (size > largest || !hierarchy.has_room({block, size}))) {
    for (const std::int32_t row : {2 * block.row, 2 * block.row + 1}) {
      for (const std::int32_t column : {2 * block.column, 2 * block.column + 1}) {
        const bool inside = column < hierarchy.columns(size - 1) && row < hierarchy.rows(size - 1);
        if (inside) cover(hierarchy, views, end, {size - 1, column, row});
      }
    }
    views_in_reach_.resize(end);
    return;
  }
  views_in_reach_.resize(end);
  while (!hierarchy.has_room({block, level})) --level;
  add({block, level});
}

void Cover::add(const Leaf& leaf) {
  leaves_.push_back(leaf);
  const auto& [size, west, south] = leaf.block;
  const std::int32_t east = std::min((west + 1) << size, columns_);
  const std::int32_t north = std::min((south + 1) << size, rows_);
  for (std::int32_t row = south << size; row < north; ++row) {
    for (std::int32_t column = west << size; column < east; ++column) {
      levels_[place(column, row)] = static_cast<std::int8_t>(leaf.level);
    }
  }
}

std::int32_t Cover::level_over(std::int32_t column, std::int32_t row) const {
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return kNone;
  return levels_[place(column, row)];
}

Rim rim_of(const Leaf& leaf, const Cover& cover, const Neighbours& neighbours) {
  const Block& block = leaf.block;
  const std::int32_t span = 1 << block.size;
  const std::int32_t west = block.column * span, east = std::min(west + span, cover.columns());
  const std::int32_t south = block.row * span, north = std::min(south + span, cover.rows());
  if (leaf.level != kCoarsest) {
    const auto all = [](std::int32_t blocks) { return ~0U >> (32 - blocks); };
    return {all(east - west), all(east - west), all(north - south), all(north - south)};
  }
  // Beyond the tile's edge lies the neighbour's first or last block.
  const auto beyond = [&](std::int32_t column, std::int32_t row) {
    if (column < 0) return neighbours.west ? neighbours.west->level_over(cover.columns() - 1, row) : Cover::kNone;
    if (column >= cover.columns()) return neighbours.east ? neighbours.east->level_over(0, row) : Cover::kNone;
    if (row < 0) return neighbours.south ? neighbours.south->level_over(column, cover.rows() - 1) : Cover::kNone;
    if (row >= cover.rows()) return neighbours.north ? neighbours.north->level_over(column, 0) : Cover::kNone;
    return cover.level_over(column, row);
  };
  Rim rim{};
  const auto add = [&](Side side, std::int32_t at, std::int32_t level) {
    if (level != Cover::kNone && level != kCoarsest) rim[side] |= 1U << at;
  };
  for (std::int32_t column = west; column < east; ++column) {
    add(kSouth, column - west, beyond(column, south - 1));
    add(kNorth, column - west, beyond(column, north));
  }
  for (std::int32_t row = south; row < north; ++row) {
    add(kWest, row - south, beyond(west - 1, row));
    add(kEast, row - south, beyond(east, row));
  }
  return rim;
}

}  // namespace ensonify::lod

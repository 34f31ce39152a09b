#include "kernels/mesh/lod/cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace ensonify::lod {
namespace {

/// The greatest size of a block that a view intersects. Smaller ones make more blocks, whose neighbours change as the
/// view moves; of larger ones much is built that the view does not examine.
constexpr std::int32_t kLargestInView = 1;

using terrain::Tile;
using terrain::Vec2;

/// A post of a tile.
struct Post {
  std::int32_t column, row;
  bool operator==(const Post&) const = default;
};

/// Every 2^level-th post of a row or column, and the last.
std::vector<std::int32_t> steps(std::int32_t first, std::int32_t last, std::int32_t level) {
  std::vector<std::int32_t> all;
  for (std::int32_t at = first; at < last; at += 1 << level) all.push_back(at);
  all.push_back(last);
  return all;
}

/// The posts of a side of a block: all, or the ends alone, of each block of size 0.
std::vector<std::int32_t> rim_steps(std::int32_t first, std::int32_t last, std::uint32_t all_posts) {
  std::vector<std::int32_t> all;
  all.reserve(static_cast<std::size_t>(last - first) + 1);
  for (std::int32_t from = first; from < last; from += kBlockCells, all_posts >>= 1) {
    const std::int32_t to = std::min(from + kBlockCells, last), step = all_posts & 1 ? 1 : kBlockCells;
    for (std::int32_t at = from; at < to; at += step) all.push_back(at);
  }
  all.push_back(last);
  return all;
}

/// Grids of posts of a block.
class Builder {
 public:
  Builder(const Tile& tile, const Posts& under, const Vec2& origin_enu_m) : tile_(tile), under_(under) {
    for (std::int32_t column = under.west; column <= under.east; ++column)
      x_m_.push_back(static_cast<float>(tile.position_enu_m(column, under.south).x() - origin_enu_m.x()));
    for (std::int32_t row = under.south; row <= under.north; ++row) {
      y_m_.push_back(static_cast<float>(tile.position_enu_m(under.west, row).y() - origin_enu_m.y()));
      // Rows lie far apart in memory: all are asked for at once.
      for (const std::int32_t column : {under.west, (under.west + under.east) / 2, under.east})
        __builtin_prefetch(&tile.height_m[tile.post(column, row)]);
    }
  }

  /// Room for a grid of so many vertices and a rim.
  void reserve(std::size_t vertices) {
    const std::size_t around = 2 * (x_m_.size() + y_m_.size());
    patch_.vertices_m.reserve(vertices + 9 * around / 4 + 36);
    patch_.grids.reserve(around / 4 + 5);
  }

  /// A grid of posts: `at(column, row)` of the grid.
  template <class At>
  void add(std::size_t columns, std::size_t rows, const At& at) {
    const std::size_t first = patch_.vertices_m.size();
    patch_.vertices_m.resize(first + columns * rows);
    Eigen::Vector3f* next = &patch_.vertices_m[first];
    bool whole = true;
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t column = 0; column < columns; ++column) {
        const Post post = at(column, row);
        const float z_m = tile_.height_m[tile_.post(post.column, post.row)];
        *next++ = {x_m_[static_cast<std::size_t>(post.column - under_.west)],
                   y_m_[static_cast<std::size_t>(post.row - under_.south)], z_m};
        whole = whole && std::isfinite(z_m);
      }
    }
    if (whole) return add_grid(first, columns, columns, rows);
    for (std::size_t row = 0; row + 1 < rows; ++row) {
      for (std::size_t column = 0; column + 1 < columns; ++column) {
        const std::size_t corner = first + row * columns + column;
        const auto finite = [&](std::size_t vertex) { return std::isfinite(patch_.vertices_m[vertex].z()); };
        if (finite(corner) && finite(corner + 1) && finite(corner + columns) && finite(corner + columns + 1)) {
          add_grid(corner, columns, 2, 2);
        }
      }
    }
  }

  /// What lies between two lines of posts, inner ones to the left of the outer ones' way. A ray tracer counts grids by
  /// squares of 2 x 2 cells. Where there are more posts outside than inside, a square takes four steps outside and one
  /// inside: five triangles, and three that are none.
  void add_strip(const std::vector<Post>& outer, const std::vector<Post>& inner) {
    std::vector<std::size_t> ends{0};  // of squares, among the posts
    while (ends.back() + 1 < outer.size()) {
      const std::size_t first = ends.back();
      std::size_t end = first + 1;
      while (end - first < 4 && end + 1 < outer.size() && inner[end] == inner[first]) ++end;
      ends.push_back(end);
    }
    const bool fewer = 3 * ends.size() < outer.size();  // than 2 x 2 cells of one strip by a good deal
    if (!fewer || has_hole(outer) || has_hole(inner))
      return add(outer.size(), 2, [&](std::size_t i, std::size_t row) { return row == 0 ? outer[i] : inner[i]; });
    for (std::size_t square = 0; square + 1 < ends.size(); ++square) {
      const std::size_t first = ends[square], end = ends[square + 1];
      const auto out = [&](std::size_t step) { return outer[std::min(first + step, end)]; };
      const Post in = inner[first];
      const std::array<Post, 9> posts{out(0), out(1), out(2), in, in, out(3), in, inner[end], out(4)};
      add(3, 3, [&](std::size_t column, std::size_t row) { return posts[3 * row + column]; });
    }
  }

  Patch take() { return std::move(patch_); }

 private:
  bool has_hole(const std::vector<Post>& posts) const {
    return std::ranges::any_of(
        posts, [&](const Post& post) { return !std::isfinite(tile_.height_m[tile_.post(post.column, post.row)]); });
  }

  void add_grid(std::size_t first, std::size_t stride, std::size_t columns, std::size_t rows) {
    patch_.grids.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(stride),
                            static_cast<std::uint16_t>(columns), static_cast<std::uint16_t>(rows)});
  }

  const Tile& tile_;
  Posts under_;
  std::vector<float> x_m_, y_m_;  // of the block's columns and rows, as the ray tracer has them
  Patch patch_;
};

/// For each outer post the inner one that stands across the rim from it: of those that the rim's inner edge has, the
/// last that is not beyond it, or the first. Both run the same way.
std::vector<std::int32_t> across(const std::vector<std::int32_t>& outer, const std::vector<std::int32_t>& own) {
  const auto way = [&](std::int32_t post) { return std::abs(post - outer.front()); };
  auto at = own.begin() + 1;
  const auto last = own.end() - 2;
  std::vector<std::int32_t> inner;
  inner.reserve(outer.size());
  for (const std::int32_t post : outer) {
    while (at != last && way(*(at + 1)) <= way(post)) ++at;
    inner.push_back(*at);
  }
  return inner;
}

/// One grid for each block of size 0, whatever the size of the block: so a ray hits the same grids.
Patch all_posts(const Tile& tile, const Posts& posts, const Vec2& origin_enu_m) {
  Builder builder(tile, posts, origin_enu_m);
  for (std::int32_t south = posts.south; south < posts.north; south += kBlockCells) {
    for (std::int32_t west = posts.west; west < posts.east; west += kBlockCells) {
      const std::int32_t columns = std::min(kBlockCells, posts.east - west) + 1;
      const std::int32_t rows = std::min(kBlockCells, posts.north - south) + 1;
      builder.add(static_cast<std::size_t>(columns), static_cast<std::size_t>(rows),
                  [&](std::size_t column, std::size_t row) {
                    return Post{west + static_cast<std::int32_t>(column), south + static_cast<std::int32_t>(row)};
                  });
    }
  }
  return builder.take();
}

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

std::size_t Patch::triangles() const {
  std::size_t sum = 0;
  for (const Grid& grid : grids) sum += 2 * std::size_t(grid.columns - 1) * std::size_t(grid.rows - 1);
  return sum;
}

Patch patch_of(const Tile& tile, const Hierarchy& hierarchy, const Leaf& leaf, const Rim& rim,
               const Vec2& origin_enu_m) {
  if (leaf.level == 0) return all_posts(tile, hierarchy.posts(leaf.block), origin_enu_m);
  const Posts under = hierarchy.posts(leaf.block);
  const auto columns = steps(under.west, under.east, leaf.level), rows = steps(under.south, under.north, leaf.level);
  Builder builder(tile, under, origin_enu_m);
  builder.reserve((columns.size() - 2) * (rows.size() - 2));
  builder.add(columns.size() - 2, rows.size() - 2, [&](std::size_t column, std::size_t row) {
    return Post{columns[column + 1], rows[row + 1]};
  });
  // Counterclockwise around the block.
  const auto add_side = [&](Side side) {
    const bool in_row = side == kSouth || side == kNorth, back = side == kNorth || side == kWest;
    auto own = in_row ? columns : rows;
    auto outer = rim_steps(own.front(), own.back(), rim[side]);
    if (back) std::ranges::reverse(own), std::ranges::reverse(outer);
    const auto& lines = in_row ? rows : columns;
    const bool first = side == kSouth || side == kWest;
    const std::int32_t edge = first ? lines.front() : lines.back();
    const std::int32_t inside = first ? lines[1] : lines[lines.size() - 2];
    const auto posts = [&](const std::vector<std::int32_t>& along, std::int32_t line) {
      std::vector<Post> all;
      all.reserve(along.size());
      for (const std::int32_t at : along) all.push_back(in_row ? Post{at, line} : Post{line, at});
      return all;
    };
    builder.add_strip(posts(outer, edge), posts(across(outer, own), inside));
  };
  for (const Side side : {kSouth, kEast, kNorth, kWest}) add_side(side);
  return builder.take();
}

}  // namespace ensonify::lod

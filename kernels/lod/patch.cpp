#include "kernels/lod/patch.h"

#include <algorithm>
#include <cmath>

namespace ensonify::lod {
namespace {

using terrain::Tile;
using terrain::Vec2;

/// A post of a tile.
struct Post {
  std::int32_t column, row;
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
  all.reserve(static_cast<std::size_t>(last - first + 1));
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

  Patch take() { return std::move(patch_); }

 private:
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
/// last that is not beyond it, or the first.
std::vector<std::int32_t> across(const std::vector<std::int32_t>& outer, const std::vector<std::int32_t>& own) {
  auto at = own.begin() + 1;
  const auto last = own.end() - 2;
  std::vector<std::int32_t> inner;
  inner.reserve(outer.size());
  for (const std::int32_t post : outer) {
    while (at != last && *(at + 1) <= post) ++at;
    inner.push_back(*at);
  }
  return inner;
}

/// One grid for each block of size 0, whatever the size of the block: so a ray meets the same grids.
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
  builder.add(columns.size() - 2, rows.size() - 2, [&](std::size_t column, std::size_t row) {
    return Post{columns[column + 1], rows[row + 1]};
  });
  const auto along_row = [&](Side side, std::int32_t outer_row, std::int32_t inner_row) {
    const auto outer = rim_steps(under.west, under.east, rim[side]), inner = across(outer, columns);
    const bool outside_first = side == kSouth;
    builder.add(outer.size(), 2, [&](std::size_t i, std::size_t row) {
      return (row == 0) == outside_first ? Post{outer[i], outer_row} : Post{inner[i], inner_row};
    });
  };
  const auto along_column = [&](Side side, std::int32_t outer_column, std::int32_t inner_column) {
    const auto outer = rim_steps(under.south, under.north, rim[side]), inner = across(outer, rows);
    const bool outside_first = side == kWest;
    builder.add(2, outer.size(), [&](std::size_t column, std::size_t i) {
      return (column == 0) == outside_first ? Post{outer_column, outer[i]} : Post{inner_column, inner[i]};
    });
  };
  along_row(kSouth, under.south, rows[1]);
  along_row(kNorth, under.north, rows[rows.size() - 2]);
  along_column(kWest, under.west, columns[1]);
  along_column(kEast, under.east, columns[columns.size() - 2]);
  return builder.take();
}

}  // namespace ensonify::lod

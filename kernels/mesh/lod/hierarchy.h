#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "kernels/mesh/tile.h"

/// View-dependent level of detail of regular terrain (docs/physics/mesh/level-of-detail.md).
namespace ensonify::lod {

/// Cells of a tile to a side of a block of size 0.
constexpr std::int32_t kBlockCells = 32;

/// The coarsest level there is; level 0 is all posts of a tile, another every 2^level-th. The coarsest step, 2^5 cells,
/// does not exceed a block of size 0: so the corners of all blocks are posts of every level.
constexpr std::int32_t kCoarsest = 5;
/// The greatest size of a block.
constexpr std::int32_t kLargest = 5;

/// A square of a tile; four blocks of one size lie under a block of the next. Columns count to the east and rows to the
/// north, in blocks of that size.
struct Block {
  std::int32_t size = 0;
  std::int32_t column = 0;
  std::int32_t row = 0;
  auto operator<=>(const Block&) const = default;
};

/// A block as a mesh shows it.
struct Leaf {
  Block block;
  std::int32_t level = 0;
  auto operator<=>(const Leaf&) const = default;
};

/// Cells that a block of a size spans, before it is cut off at the tile's edge.
constexpr std::int32_t span_cells(std::int32_t size) { return kBlockCells << size; }

struct Sphere {
  terrain::Vec3 centre_enu_m = terrain::Vec3::Zero();
  double radius_m = 0.0;
};

/// Posts of a tile from west to east and from south to north, the last ones included.
struct Posts {
  std::int32_t west = 0, east = 0;    // columns
  std::int32_t south = 0, north = 0;  // rows
};

/// The implicit hierarchy of a tile's posts: blocks of every size, and a sphere around each. Made once when a tile
/// comes, from the least and greatest heights under each block; it holds no posts.
class Hierarchy {
 public:
  /// `tile` has no fault (terrain::fault_of).
  explicit Hierarchy(const terrain::Tile& tile);

  std::int32_t columns(std::int32_t size) const { return sizes_[static_cast<std::size_t>(size)].columns; }
  std::int32_t rows(std::int32_t size) const { return sizes_[static_cast<std::size_t>(size)].rows; }
  Posts posts(const Block& block) const;

  /// Whether all posts under the block are holes.
  bool empty(const Block& block) const { return !(bounds(block).lowest_m <= bounds(block).highest_m); }
  /// Around all posts under the block: its lowest and its highest corner. Of a block that is not empty.
  std::array<terrain::Vec3, 2> box_enu_m(const Block& block) const;
  /// Around all posts under the block, so around what any level shows of them; 1 cm more than they need, for what
  /// floats round and chords of refracted rays leave out. Of a block that is not empty.
  Sphere sphere(const Block& block) const;

  /// Whether a mesh can show the block so coarsely: with fewer than three cells to a side there is no room inside its
  /// rim, which a block of level 0 does not need.
  bool has_room(const Leaf& leaf) const;

 private:
  struct Bounds {
    float lowest_m, highest_m;
  };
  struct Size {
    std::int32_t columns, rows;
    std::vector<Bounds> bounds;
  };
  static Bounds bounds_under(const terrain::Tile& tile, const Posts& under);
  const Bounds& bounds(const Block& block) const;

  terrain::Vec2 origin_enu_m_;
  double spacing_m_;
  std::int32_t last_column_, last_row_;  // of posts
  std::vector<Size> sizes_;              // kLargest + 1
};

}  // namespace ensonify::lod

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/mesh/lod/frustum.h"
#include "kernels/mesh/lod/hierarchy.h"
#include "kernels/mesh/tile.h"

namespace ensonify::lod {

/// View of the seabed, and the coarsest level allowed there.
struct View {
  Frustum frustum;
  std::int32_t level = 0;

  bool operator==(const View&) const = default;
};

/// A tile covered by blocks, each post's surroundings once: as coarse as the views allow, and coarsest where nothing
/// points, save where a block has no room to be so. A function of the tile and the views.
class Cover {
 public:
  /// Blocks that are all holes are left out.
  void choose(const Hierarchy& hierarchy, std::span<const View> views);

  /// All at full detail, in the largest blocks.
  void choose_all(const Hierarchy& hierarchy);

  const std::vector<Leaf>& leaves() const { return leaves_; }

  /// Level by which the block of size 0 is shown; kNone outside the tile and where all is holes.
  std::int32_t level_over(std::int32_t column, std::int32_t row) const;
  std::int32_t columns() const { return columns_; }
  std::int32_t rows() const { return rows_; }

  static constexpr std::int32_t kNone = -1;

 private:
  void clear(const Hierarchy& hierarchy);
  struct PreparedView;  // a view, prepared
  void cover(const Hierarchy& hierarchy, std::span<const PreparedView> views, std::size_t first, const Block& block);
  void add(const Leaf& leaf);
  /// In levels_.
  std::size_t place(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }

  std::int32_t columns_ = 0, rows_ = 0;  // blocks of size 0
  std::vector<Leaf> leaves_;
  std::vector<std::int8_t> levels_;
  std::vector<std::size_t> views_in_reach_;  // views that may hit the blocks in work, of each from its first on
};

/// Covers around a tile; null: no tile there, or none whose edge posts are the same.
struct Neighbours {
  const Cover* west = nullptr;
  const Cover* east = nullptr;
  const Cover* south = nullptr;
  const Cover* north = nullptr;
};

enum Side : std::uint8_t { kSouth, kNorth, kWest, kEast };

/// Which parts of a leaf's sides show all posts: a bit for each block of size 0 along a side, the lowest at its start
/// to the east or the north. All do, save where the leaf and its neighbour are both coarsest: so the rim of a finer
/// leaf stays the same, whatever becomes of its neighbours.
using Rim = std::array<std::uint32_t, 4>;  // by Side

Rim rim_of(const Leaf& leaf, const Cover& cover, const Neighbours& neighbours);

/// Triangles as grids of vertices: each cell of a grid is two, cut from its north-west to its south-east corner.
/// Vertices are floats, relative to an origin (z to zero), for a ray tracer.
struct Patch {
  struct Grid {
    std::uint32_t first = 0;              // vertex at the south-west corner
    std::uint32_t stride = 0;             // vertices from one row to the next
    std::uint16_t columns = 0, rows = 0;  // of vertices
  };
  std::vector<Eigen::Vector3f> vertices_m;
  std::vector<Grid> grids;

  std::size_t triangles() const;
};

/// The triangles of a leaf. One of level 0 is all of its cells. A coarser one has a rim one cell wide: its outer edge
/// has the posts that the neighbours have there, and them alone, so that the two share every edge of a triangle, to the
/// bit. No cell that has a hole at a corner is in it.
Patch patch_of(const terrain::Tile& tile, const Hierarchy& hierarchy, const Leaf& leaf, const Rim& rim,
               const terrain::Vec2& origin_enu_m);

}  // namespace ensonify::lod

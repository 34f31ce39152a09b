#pragma once

#include <compare>
#include <cstdint>

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

}  // namespace ensonify::lod

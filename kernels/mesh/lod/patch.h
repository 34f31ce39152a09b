#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "kernels/mesh/lod/cover.h"
#include "kernels/mesh/lod/hierarchy.h"
#include "kernels/mesh/tile.h"

namespace ensonify::lod {

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

#pragma once

#include <cstdint>
#include <vector>

#include "kernels/mesh/progressive/mesh.h"

namespace ensonify::progressive {

/// A vertex that is moved onto a neighbour; the triangles between the two are gone.
struct Collapse {
  std::uint32_t removed = 0;
  std::uint32_t kept = 0;

  bool operator==(const Collapse&) const = default;
};

/// The collapses that take a mesh to its coarsest, those that change its shape least first (quadric errors
/// [Garland1997], by OpenMesh). The surface keeps its topology and its boundary stays on the boundary, as long as all
/// are done in this order. A triangle that would make an edge have three sides is no part of this, and is carried along
/// by its corners. Throws std::invalid_argument with fault_of.
std::vector<Collapse> collapses_of(const TriangleMesh& mesh);

}  // namespace ensonify::progressive

#pragma once

#include <map>
#include <utility>

#include "kernels/mesh/solids/solid.h"

namespace ensonify::solids {

/// Every edge of a closed surface whose triangles are all seen from outside is there once in each direction.
inline bool closes(const progressive::TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangle) {
    for (std::size_t c = 0; c < 3; ++c) ++edges[{t[c], t[(c + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    if (count != 1 || edges.count({edge.second, edge.first}) == 0) return false;
  }
  return !edges.empty();
}

inline double volume_m3(const progressive::TriangleMesh& mesh) { return volume_below_m3(mesh, 1e3); }

inline Eigen::AlignedBox3d box_of(const progressive::TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : mesh.vertex_m) box.extend(mesh.origin_enu_m + vertex.cast<double>());
  return box;
}

}  // namespace ensonify::solids

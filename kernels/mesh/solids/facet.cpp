#include "kernels/mesh/solids/facet.h"

namespace ensonify::solids {

using frames::Vec3;

Vec3 middle_of_edge(const Facet& facet, std::size_t edge) {
  const Corners& corner = facet.corners;
  const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
  return 0.5 * (corner[edge] + corner[(edge + 1) % 3]) + facet.bulge_m[edge] * normal;
}

Facet facet_of(const Surface& surface, std::size_t triangle) {
  Facet facet;
  const progressive::TriangleMesh& mesh = surface.mesh;
  for (std::size_t c = 0; c < 3; ++c) {
    facet.corners[c] = mesh.origin_enu_m + mesh.vertex_m[mesh.triangle[triangle][c]].cast<double>();
    if (!surface.bulge_m.empty()) facet.bulge_m[c] = static_cast<double>(surface.bulge_m[triangle][c]);
  }
  return facet;
}

}  // namespace ensonify::solids

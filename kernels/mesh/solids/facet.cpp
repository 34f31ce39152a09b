#include "kernels/mesh/solids/facet.h"

namespace ensonify::solids {

using frames::Vec3;

Vec3 middle_of_edge(const Facet& facet, std::size_t edge) {
  const Corners& corner = facet.corners;
  const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
  return 0.5 * (corner[edge] + corner[(edge + 1) % 3]) + facet.bulge_m[edge] * normal;
}

std::optional<std::array<Facet, 2>> cut(const Facet& facet, double longest_m) {
  const Corners& corner = facet.corners;
  const std::array<double, 3>& bulge_m = facet.bulge_m;
  const auto length2 = [&](std::size_t c) { return (corner[(c + 1) % 3] - corner[c]).squaredNorm(); };
  std::size_t edge = 0;
  for (const std::size_t c : {1U, 2U}) {
    if (length2(c) > length2(edge)) edge = c;
  }
  if (length2(edge) <= longest_m * longest_m) return std::nullopt;
  const std::size_t next = (edge + 1) % 3, last = (edge + 2) % 3;
  const Vec3 middle = middle_of_edge(facet, edge);
  const double cut_m = 0.5 * (bulge_m[next] + bulge_m[last]) - 0.25 * bulge_m[edge];  // of the way to the third corner
  return std::array{Facet{{corner[edge], middle, corner[last]}, {0.25 * bulge_m[edge], cut_m, bulge_m[last]}},
                    Facet{{middle, corner[next], corner[last]}, {0.25 * bulge_m[edge], bulge_m[next], cut_m}}};
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

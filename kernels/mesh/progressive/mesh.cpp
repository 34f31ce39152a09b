#include "kernels/mesh/progressive/mesh.h"

#include <cstddef>

namespace ensonify::progressive {

std::string fault_of(const TriangleMesh& mesh) {
  if (!mesh.origin_enu_m.allFinite()) return "the origin is not finite";
  for (std::size_t v = 0; v < mesh.vertex_m.size(); ++v) {
    if (!mesh.vertex_m[v].allFinite()) return "vertex " + std::to_string(v) + " is not finite";
  }
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
    const auto& [a, b, c] = mesh.triangle[t];
    if (a >= mesh.vertex_m.size() || b >= mesh.vertex_m.size() || c >= mesh.vertex_m.size())
      return "triangle " + std::to_string(t) + " has a corner that is no vertex";
    if (a == b || b == c || c == a) return "triangle " + std::to_string(t) + " has a corner twice";
  }
  return "";
}

lod::Sphere sphere_around(const Eigen::AlignedBox3f& box_m, const frames::Vec3& origin_enu_m) {
  const frames::Vec3 low = box_m.min().cast<double>(), high = box_m.max().cast<double>();
  return {origin_enu_m + 0.5 * (low + high), 0.5 * (high - low).norm() + kSlack_m};
}

}  // namespace ensonify::progressive

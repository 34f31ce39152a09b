#include "kernels/mesh/progressive/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace ensonify::progressive {
namespace {

/// A place of the plane over the way: how far along, and how high.
struct OnPlane {
  double along_m, z_m;
};

/// The least distance along the part of a chord that is on the way and at or above the height.
double least_along_m(OnPlane a, OnPlane b, double length_m, double least_z_m) {
  constexpr double kNone_m = std::numeric_limits<double>::infinity();
  if (a.along_m > b.along_m) std::swap(a, b);
  const double run_m = b.along_m - a.along_m, rise_m = b.z_m - a.z_m;
  double first = 0.0, last = 1.0;                            // shares of the chord
  const auto keep_above = [&](double value, double slope) {  // value + slope * share >= 0
    if (slope > 0.0) first = std::max(first, -value / slope);
    else if (slope < 0.0) last = std::min(last, -value / slope);
    else if (value < 0.0) last = -1.0;
  };
  keep_above(a.along_m, run_m);
  keep_above(length_m - a.along_m, -run_m);
  keep_above(a.z_m - least_z_m, rise_m);
  return first <= last ? a.along_m + first * run_m : kNone_m;
}

}  // namespace

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

std::optional<double> first_crossing_m(const TriangleMesh& mesh, const Way& way) {
  const frames::Vec2 over = way.to_enu_m - way.from_enu_m;
  const double length_m = over.norm(), least_z_m = way.above_z_m - kSlack_m - mesh.origin_enu_m.z();
  if (!(length_m > 0.0)) return std::nullopt;
  const frames::Vec2 along = over / length_m, beside(along.y(), -along.x());
  const frames::Vec2 start = way.from_enu_m - mesh.origin_enu_m.head<2>();
  double first_m = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : mesh.triangle) {
    std::array<double, 3> off_m{};
    std::array<OnPlane, 3> corner{};
    for (std::size_t i = 0; i < 3; ++i) {
      const frames::Vec3 place = mesh.vertex_m[triangle[i]].cast<double>();
      const frames::Vec2 from_start = place.head<2>() - start;
      off_m[i] = from_start.dot(beside);
      corner[i] = {from_start.dot(along), place.z()};
    }
    // Two sides at most have their ends on different sides of the plane, where on it counts as beyond it.
    std::array<OnPlane, 3> crossings{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if ((off_m[i] < 0.0) == (off_m[j] < 0.0)) continue;
      const double share = off_m[i] / (off_m[i] - off_m[j]);
      crossings[count++] = {std::lerp(corner[i].along_m, corner[j].along_m, share),
                            std::lerp(corner[i].z_m, corner[j].z_m, share)};
    }
    if (count == 2) first_m = std::min(first_m, least_along_m(crossings[0], crossings[1], length_m, least_z_m));
  }
  if (!std::isfinite(first_m)) return std::nullopt;
  return first_m;
}

}  // namespace ensonify::progressive

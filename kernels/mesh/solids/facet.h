#pragma once

#include <array>
#include <cstddef>

#include "kernels/base/frames/attitude.h"
#include "kernels/mesh/solids/solid.h"

namespace ensonify::solids {

using Corners = std::array<frames::Vec3, 3>;

/// A triangle that may be curved: a quadratic surface over its corners. Edge c goes from corner c to the next one.
struct Facet {
  Corners corners;
  std::array<double, 3> bulge_m{};  // height of the surface over the middle of each edge, along the normal
};

inline frames::Vec3 middle_of(const Facet& facet) {
  return (facet.corners[0] + facet.corners[1] + facet.corners[2]) / 3.0;
}
/// Along its normal, as long as twice its area.
inline frames::Vec3 across(const Facet& facet) {
  return (facet.corners[1] - facet.corners[0]).cross(facet.corners[2] - facet.corners[0]);
}

/// Height over the middle of an edge of a surface whose unit normals at its ends are known: it bulges by what these
/// differ along it.
inline float bulge_m(const frames::Vec3& from, const frames::Vec3& to, const frames::Vec3& normal_from,
                     const frames::Vec3& normal_to) {
  return static_cast<float>(0.125 * (to - from).dot(normal_to - normal_from));
}

/// A triangle of a surface, in its frame.
Facet facet_of(const Surface& surface, std::size_t triangle);

/// The middle of an edge, on the surface.
frames::Vec3 middle_of_edge(const Facet& facet, std::size_t edge);

/// Calls each(facet) for the parts of a facet, cut across its longest side until none is longer.
template <class Each>
void split_facet(const Facet& facet, double longest_m, const Each& each) {
  const Corners& corner = facet.corners;
  const std::array<double, 3>& bulge_m = facet.bulge_m;
  const auto length2 = [&](std::size_t c) { return (corner[(c + 1) % 3] - corner[c]).squaredNorm(); };
  std::size_t edge = 0;
  for (const std::size_t c : {1U, 2U}) {
    if (length2(c) > length2(edge)) edge = c;
  }
  if (length2(edge) <= longest_m * longest_m) return each(facet);
  const std::size_t next = (edge + 1) % 3, last = (edge + 2) % 3;
  const frames::Vec3 middle = middle_of_edge(facet, edge);
  const double cut_m = 0.5 * (bulge_m[next] + bulge_m[last]) - 0.25 * bulge_m[edge];  // of the way to the third corner
  split_facet(Facet{{corner[edge], middle, corner[last]}, {0.25 * bulge_m[edge], cut_m, bulge_m[last]}}, longest_m,
              each);
  split_facet(Facet{{middle, corner[next], corner[last]}, {0.25 * bulge_m[edge], bulge_m[next], cut_m}}, longest_m,
              each);
}

}  // namespace ensonify::solids

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

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

/// The two parts of a facet that is cut across its longest side; nothing where no side is longer.
std::optional<std::array<Facet, 2>> cut(const Facet& facet, double longest_m);

/// Calls each(facet) for the parts of a facet, cut across its longest side until none is longer.
template <class Each>
void split_facet(const Facet& facet, double longest_m, const Each& each) {
  const auto parts = cut(facet, longest_m);
  if (!parts) return each(facet);
  for (const Facet& part : *parts) split_facet(part, longest_m, each);
}

/// The same without parts that do not meet something, which are not cut further: each(facet, way). The way to a part is
/// the same whatever is left out: after a leading 1 a bit for each cut.
template <class Meets, class Each>
void split_facet_where(const Meets& meets, const Facet& facet, double longest_m, const Each& each,
                       std::uint32_t way = 1) {
  if (!meets(facet)) return;
  const auto parts = cut(facet, longest_m);
  if (!parts) return each(facet, way);
  split_facet_where(meets, (*parts)[0], longest_m, each, 2 * way);
  split_facet_where(meets, (*parts)[1], longest_m, each, 2 * way + 1);
}

}  // namespace ensonify::solids

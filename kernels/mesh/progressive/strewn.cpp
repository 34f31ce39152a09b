#include "kernels/mesh/progressive/strewn.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ensonify::progressive {
namespace {

std::int32_t shifted(std::int32_t split, std::size_t by) {
  return split == kNone ? kNone : split + static_cast<std::int32_t>(by);
}

/// One copy where it stands, about its own origin.
Hierarchy stood(Hierarchy one, const Copy& copy) {
  const auto scale = static_cast<float>(copy.scale);
  one.mesh.origin_enu_m *= copy.scale;
  for (Eigen::Vector3f& vertex : one.mesh.vertex_m) vertex *= scale;
  for (Split& split : one.splits) split.deviation_m *= scale;
  return placed(std::move(one), copy.position_enu_m, copy.heading_rad);
}

/// Rounding keeps order, so boxes still hold what they held.
void append(const Hierarchy& one, Hierarchy& all) {
  const frames::Vec3 by = one.mesh.origin_enu_m - all.mesh.origin_enu_m;
  const auto moved = [&](const Eigen::Vector3f& place) { return (place.cast<double>() + by).cast<float>().eval(); };
  const auto vertices = static_cast<std::uint32_t>(all.mesh.vertex_m.size());
  const auto triangles = static_cast<std::uint32_t>(all.mesh.triangle.size());
  const auto born = static_cast<std::uint32_t>(all.born.size());
  const std::size_t splits = all.splits.size();
  for (const auto& vertex : one.mesh.vertex_m) all.mesh.vertex_m.push_back(moved(vertex));
  for (const auto& [a, b, c] : one.mesh.triangle)
    all.mesh.triangle.push_back({a + vertices, b + vertices, c + vertices});
  for (Split split : one.splits) {
    split.removed += vertices;
    split.kept += vertices;
    split.parent = shifted(split.parent, splits);
    for (std::int32_t& child : split.child) child = shifted(child, splits);
    split.first_born += born;
    split.box_m = {moved(split.box_m.min()), moved(split.box_m.max())};
    all.splits.push_back(split);
  }
  for (const std::uint32_t triangle : one.born) all.born.push_back(triangle + triangles);
  for (const std::uint32_t triangle : one.coarsest) all.coarsest.push_back(triangle + triangles);
  for (const std::int32_t split : one.split_of) all.split_of.push_back(shifted(split, splits));
}

}  // namespace

Copy drawn(const Strewn& strewn, const random::Stream& stream, std::uint64_t n) {
  if (!(strewn.least_scale > 0.0 && strewn.most_scale >= strewn.least_scale && strewn.size_exponent > 0.0 &&
        strewn.width_m >= 0.0))
    throw std::invalid_argument("strewn: allowed are 0 < least_scale <= most_scale, size_exponent > 0, width_m >= 0");
  const frames::Vec2 line = strewn.to_enu_m - strewn.from_enu_m;
  const frames::Vec2 across = frames::Vec2(line.y(), -line.x()).normalized();
  const frames::Vec2 place =
      strewn.from_enu_m + stream.uniform(n, 0) * line + strewn.width_m * (stream.uniform(n, 1) - 0.5) * across;
  // By inversion, as kernels/seabed/relief/bodies.cpp.
  const double share = std::pow(strewn.least_scale / strewn.most_scale, strewn.size_exponent);
  const double u = share + (1.0 - share) * stream.uniform(n, 2);
  return {{place.x(), place.y(), 0.0},
          2.0 * std::numbers::pi * stream.uniform(n, 3),
          strewn.least_scale * std::pow(u, -1.0 / strewn.size_exponent)};
}

Hierarchy copies_of(const Hierarchy& one, std::span<const Copy> copies) {
  Hierarchy all;
  frames::Vec3 middle = frames::Vec3::Zero();
  for (const Copy& copy : copies) middle += copy.position_enu_m / static_cast<double>(copies.size());
  all.mesh.origin_enu_m = middle.array().round() + 0.0;  // no -0
  for (const Copy& copy : copies) append(stood(one, copy), all);
  return all;
}

}  // namespace ensonify::progressive

#include "kernels/mesh/progressive/objects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ensonify::progressive {
namespace {

using frames::Vec2;
using frames::Vec3;

/// Corners of the section, counterclockwise as seen from its end.
std::vector<Vec2> section_of(const Bar& bar) {
  if (bar.diameter_m == 0.0) {
    const Vec2 half = 0.5 * bar.section_m;
    return {{-half.x(), -half.y()}, {half.x(), -half.y()}, {half.x(), half.y()}, {-half.x(), half.y()}};
  }
  std::vector<Vec2> corners;
  for (int i = 0; i < Bar::kSides; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / Bar::kSides;
    corners.emplace_back(0.5 * bar.diameter_m * std::cos(turn), 0.5 * bar.diameter_m * std::sin(turn));
  }
  return corners;
}

int rings_of(const Bar& bar) {
  return 1 + std::max(1, static_cast<int>(std::ceil((bar.to_m - bar.from_m).norm() / kRing_m - 1e-9)));
}

/// Where each of its copies stands from itself.
std::vector<Vec3> copies_of(const Bar& bar) {
  std::vector<Vec3> off_m = {Vec3::Zero()};
  for (const Repeat& repeat : bar.repeat) {
    std::vector<Vec3> more_m;
    for (const Vec3& at : off_m) {
      for (int i = 0; i < repeat.count; ++i) more_m.emplace_back(at + i * repeat.step_m);
    }
    off_m = std::move(more_m);
  }
  return off_m;
}

void check(const Bar& bar) {
  if (!((bar.to_m - bar.from_m).norm() > 0.0)) throw std::invalid_argument("bar: its ends are at one place");
  if (!(bar.diameter_m > 0.0 || (bar.diameter_m == 0.0 && (bar.section_m.array() > 0.0).all())))
    throw std::invalid_argument("bar: has no section; allowed is a diameter or two widths above 0 m");
  for (const Repeat& repeat : bar.repeat) {
    if (repeat.count < 1) throw std::invalid_argument("bar: is repeated less than once");
  }
}

void add(const Bar& bar, const Vec3& off_m, TriangleMesh& mesh) {
  const std::vector<Vec2> section = section_of(bar);
  const auto sides = static_cast<std::uint32_t>(section.size()), rings = static_cast<std::uint32_t>(rings_of(bar));
  const Vec3 along = (bar.to_m - bar.from_m).normalized();
  const bool upright = along.head<2>().norm() < 1e-9;
  const Vec3 level = upright ? Vec3::UnitX() : along.cross(Vec3::UnitZ()).normalized(), other = along.cross(level);
  const auto first = static_cast<std::uint32_t>(mesh.vertex_m.size());
  const auto vertex = [&](std::uint32_t ring, std::uint32_t side) { return first + ring * sides + side % sides; };
  const auto add_vertex = [&](const Vec3& place_m) { mesh.vertex_m.push_back((place_m + off_m).cast<float>()); };
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    const Vec3 middle_m = bar.from_m + (bar.to_m - bar.from_m) * ring / (rings - 1);
    for (const Vec2& corner : section) add_vertex(middle_m + corner.x() * level + corner.y() * other);
  }
  add_vertex(bar.from_m);
  add_vertex(bar.to_m);
  const std::uint32_t foot = first + rings * sides, head = foot + 1;
  for (std::uint32_t side = 0; side < sides; ++side) {
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
      mesh.triangle.push_back({vertex(ring, side), vertex(ring, side + 1), vertex(ring + 1, side + 1)});
      mesh.triangle.push_back({vertex(ring, side), vertex(ring + 1, side + 1), vertex(ring + 1, side)});
    }
    mesh.triangle.push_back({foot, vertex(0, side + 1), vertex(0, side)});
    mesh.triangle.push_back({head, vertex(rings - 1, side), vertex(rings - 1, side + 1)});
  }
}

/// Where a pile's section bends: from an interlock, along half a web, the pan, and half a web. Shares of its width, and
/// of half the profile's depth.
constexpr std::array<std::array<double, 2>, 2> kBends = {{{0.25, 1.0}, {0.75, 1.0}}};

struct Lattice {
  std::uint32_t piles, columns, rows;  // columns and rows of vertices
};

Lattice lattice_of(const SheetPileWall& wall) {
  const auto piles = static_cast<std::uint32_t>((wall.to_enu_m - wall.from_enu_m).norm() / wall.pile_width_m + 1e-9);
  const auto steps = static_cast<std::uint32_t>(std::ceil((wall.foot_depth_m + wall.top_height_m) / wall.row_m - 1e-9));
  return {piles, static_cast<std::uint32_t>(kBends.size()) * piles + 2, steps + 1};
}

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

double vertices_of(std::span<const Bar> bars) {
  double sum = 0.0;
  for (const Bar& bar : bars) {
    double of_bar = rings_of(bar) * (bar.diameter_m > 0.0 ? Bar::kSides : 4) + 2.0;
    for (const Repeat& repeat : bar.repeat) of_bar *= repeat.count;
    sum += of_bar;
  }
  return sum;
}

TriangleMesh mesh_of(std::span<const Bar> bars) {
  TriangleMesh mesh;
  for (const Bar& bar : bars) {
    check(bar);
    for (const Vec3& off_m : copies_of(bar)) add(bar, off_m, mesh);
  }
  return mesh;
}

double vertices_of(const SheetPileWall& wall) {
  const Lattice lattice = lattice_of(wall);
  return static_cast<double>(lattice.columns) * lattice.rows;
}

TriangleMesh mesh_of(const SheetPileWall& wall, const random::Stream& stream) {
  const double length_m = (wall.to_enu_m - wall.from_enu_m).norm(), height_m = wall.foot_depth_m + wall.top_height_m;
  if (!(wall.pile_width_m > 0.0 && wall.row_m > 0.0 && wall.profile_depth_m > 0.0))
    throw std::invalid_argument("wall: pile width, profile depth and rows must be above 0 m");
  if (!(length_m >= wall.pile_width_m)) throw std::invalid_argument("wall: is shorter than a pile");
  if (!(height_m > 0.0)) throw std::invalid_argument("wall: its top must be above its foot");
  const Lattice lattice = lattice_of(wall);
  const frames::Vec2 along = (wall.to_enu_m - wall.from_enu_m) / length_m, across(along.y(), -along.x());
  TriangleMesh mesh;
  const frames::Vec2 middle = 0.5 * (wall.from_enu_m + wall.to_enu_m);
  mesh.origin_enu_m << middle.array().round() + 0.0, 0.0;  // no -0
  const auto add_column = [&](double along_m, double across_m) {
    const frames::Vec2 place = wall.from_enu_m + along_m * along + across_m * across;
    for (std::uint32_t row = 0; row < lattice.rows; ++row) {
      const frames::Vec3 vertex(place.x(), place.y(), -wall.foot_depth_m + height_m * row / (lattice.rows - 1));
      mesh.vertex_m.push_back((vertex - mesh.origin_enu_m).cast<float>());
    }
  };
  add_column(0.0, 0.0);
  for (std::uint32_t pile = 0; pile < lattice.piles; ++pile) {
    const double side = pile % 2 == 0 ? 0.5 : -0.5, off_m = wall.out_of_line_m * stream.normal(pile);
    for (const auto& [share, out] : kBends)
      add_column((pile + share) * wall.pile_width_m, side * out * wall.profile_depth_m + off_m);
  }
  add_column(lattice.piles * wall.pile_width_m, 0.0);
  for (std::uint32_t column = 0; column + 1 < lattice.columns; ++column) {
    for (std::uint32_t row = 0; row + 1 < lattice.rows; ++row) {
      const std::uint32_t v = column * lattice.rows + row, beside = v + lattice.rows;
      mesh.triangle.push_back({v, beside, beside + 1});
      mesh.triangle.push_back({v, beside + 1, v + 1});
    }
  }
  return mesh;
}

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

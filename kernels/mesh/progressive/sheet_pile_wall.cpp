#include "kernels/mesh/progressive/sheet_pile_wall.h"

#include <array>
#include <cmath>
#include <stdexcept>

namespace ensonify::progressive {
namespace {

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

}  // namespace

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

}  // namespace ensonify::progressive

#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/mesh/progressive/hierarchy.h"
#include "kernels/mesh/progressive/objects.h"

using namespace ensonify;
using namespace ensonify::progressive;

namespace {

SheetPileWall straight(double length_m) {
  SheetPileWall wall;
  wall.from_enu_m = {10.0, -4.0};
  wall.to_enu_m = {10.0, -4.0 + length_m};
  wall.foot_depth_m = 12.0;
  wall.out_of_line_m = 0.0;
  return wall;
}

double area_m2(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangle) {
    const Eigen::Vector3f ab = mesh.vertex_m[b] - mesh.vertex_m[a], ac = mesh.vertex_m[c] - mesh.vertex_m[a];
    sum += 0.5 * static_cast<double>(ab.cross(ac).norm());
  }
  return sum;
}

}  // namespace

TEST_CASE("a wall of sheet piles stands where it is said, as deep as its section") {
  const TriangleMesh mesh = mesh_of(straight(24.0), {1, "wall"});
  CHECK(fault_of(mesh).empty());
  CHECK(static_cast<double>(mesh.vertex_m.size()) == vertices_of(straight(24.0)));
  Eigen::AlignedBox3d box;
  for (const auto& vertex : mesh.vertex_m) box.extend(mesh.origin_enu_m + vertex.cast<double>());
  // Floats of a metre or two about the origin: micrometres.
  CHECK((box.min() - frames::Vec3(10.0 - 0.215, -4.0, -12.0)).norm() < 1e-5);
  CHECK((box.max() - frames::Vec3(10.0 + 0.215, 20.0, 0.0)).norm() < 1e-5);
}

TEST_CASE("its area is that of its section times its height") {
  // 40 piles: each a pan of half its width and, with its neighbours, one web.
  const double web_m = std::hypot(0.3, 0.43);
  CHECK(area_m2(mesh_of(straight(24.0), {1, "wall"})) == Approx(40 * (0.3 + web_m) * 12.0).epsilon(1e-5));
}

TEST_CASE("piles stand out of line by chance, the same each time") {
  SheetPileWall wall = straight(600.0);
  wall.out_of_line_m = 0.05;
  wall.row_m = 100.0;  // two rows
  const TriangleMesh mesh = mesh_of(wall, {1, "wall"});
  CHECK(mesh.vertex_m == mesh_of(wall, {1, "wall"}).vertex_m);
  CHECK(mesh.vertex_m != mesh_of(wall, {2, "wall"}).vertex_m);
  double sum = 0.0, squares = 0.0;
  for (std::size_t pile = 0; pile < 1000; ++pile) {
    const double side_m = pile % 2 == 0 ? 0.215 : -0.215;
    const double off_m = static_cast<double>(mesh.vertex_m[2 * (1 + 2 * pile)].x()) - side_m;
    sum += off_m, squares += off_m * off_m;
  }
  // Four standard deviations of the mean of 1000, and of their standard deviation: 1 / sqrt(2000) of it.
  CHECK(std::abs(sum / 1000) < 4.0 * 0.05 / std::sqrt(1000.0));
  CHECK(std::sqrt(squares / 1000) == Approx(0.05).epsilon(4.0 / std::sqrt(2000.0)));
}

TEST_CASE("what is flat in it is given up, what stands out is not") {
  const TriangleMesh mesh = mesh_of(straight(24.0), {1, "wall"});
  const Hierarchy hierarchy = hierarchy_of(mesh, collapses_of(mesh));
  std::size_t flat = 0;  // rows between foot and top: 11 of each of the 82 columns
  for (const Split& split : hierarchy.splits) flat += split.deviation_m < 1e-5F ? 1U : 0U;
  CHECK(flat >= 82 * 11);
}

TEST_CASE("what is no wall is refused") {
  SheetPileWall wall = straight(0.5);
  CHECK_THROWS_WITH(mesh_of(wall, {1, "wall"}), "wall: is shorter than a pile");
  wall = straight(24.0);
  wall.top_height_m = -12.0;
  CHECK_THROWS_WITH(mesh_of(wall, {1, "wall"}), "wall: its top must be above its foot");
  wall = straight(24.0);
  wall.row_m = 0.0;
  CHECK_THROWS_WITH(mesh_of(wall, {1, "wall"}), "wall: pile width, profile depth and rows must be above 0 m");
}

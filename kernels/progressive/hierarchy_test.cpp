#include "kernels/progressive/hierarchy.h"

#include <catch2/catch.hpp>
#include <set>

#include "kernels/progressive/test_meshes.h"

using namespace ensonify;
using namespace ensonify::progressive;

namespace {

Hierarchy made_of(const TriangleMesh& mesh) { return hierarchy_of(mesh, collapses_of(mesh)); }

}  // namespace

TEST_CASE("a closed surface goes down to a tetrahedron, and the same way each time") {
  const TriangleMesh ball = bumpy_ball(80, 40);
  const auto collapses = collapses_of(ball);
  CHECK(collapses.size() == ball.vertex_m.size() - 4);
  CHECK(collapses_of(ball) == collapses);
  CHECK(hierarchy_of(ball, collapses).coarsest.size() == 4);
}

TEST_CASE("each triangle comes back once, each vertex by one split, parents first") {
  const Hierarchy quay = made_of(quay_wall(6.0));
  std::set<std::uint32_t> triangles(quay.coarsest.begin(), quay.coarsest.end());
  triangles.insert(quay.born.begin(), quay.born.end());
  CHECK(triangles.size() == quay.mesh.triangle.size());
  CHECK(quay.coarsest.size() + quay.born.size() == quay.mesh.triangle.size());
  std::set<std::uint32_t> vertices;
  for (std::size_t s = 0; s < quay.splits.size(); ++s) {
    const Split& split = quay.splits[s];
    vertices.insert(split.removed);
    REQUIRE(split.parent < static_cast<std::int32_t>(s));
    for (const std::int32_t child : split.child) {
      if (child == kNone) continue;
      const Split& finer = quay.splits[static_cast<std::size_t>(child)];
      REQUIRE(finer.parent == static_cast<std::int32_t>(s));
      REQUIRE(finer.deviation_m <= split.deviation_m);
      REQUIRE(split.box_m.contains(finer.box_m));
    }
  }
  CHECK(vertices.size() == quay.splits.size());
}

TEST_CASE("what is flat goes without a trace, corners of the outline and spikes last") {
  TriangleMesh flat = sheet(9, 9, [](int i, int j) { return Eigen::Vector3f(float(i), float(j), 0.0F); });
  const auto order = collapses_of(flat);
  const Hierarchy plain = hierarchy_of(flat, order);
  REQUIRE(order.size() == 81 - 3);
  for (std::size_t s = 1; s < plain.splits.size(); ++s) REQUIRE(plain.splits[s].deviation_m < 1e-5F);
  CHECK(plain.splits[0].deviation_m ==
        Approx(8.0 / std::sqrt(2.0)).epsilon(1e-4));  // the fourth corner to the diagonal
  flat.vertex_m[40].z() = 0.25F;                      // its middle
  const Hierarchy spike = made_of(flat);
  CHECK(spike.splits[static_cast<std::size_t>(spike.split_of[40])].deviation_m == Approx(0.25F).margin(0.01));
}

TEST_CASE("triangles that OpenMesh refuses are carried along") {
  TriangleMesh mesh =
      sheet(12, 12, [](int i, int j) { return Eigen::Vector3f(float(i), float(j), 0.1F * float(i % 3)); });
  mesh.vertex_m.emplace_back(5.5F, 5.5F, 3.0F);
  mesh.triangle.push_back({5 * 12 + 5, 5 * 12 + 6, 144});  // a third side on an edge inside
  const Hierarchy hierarchy = made_of(mesh);
  CHECK(hierarchy.coarsest.size() + hierarchy.born.size() == mesh.triangle.size());
}

TEST_CASE("what cannot be a mesh is refused, with its fault") {
  TriangleMesh mesh = sheet(3, 3, [](int i, int j) { return Eigen::Vector3f(float(i), float(j), 0.0F); });
  mesh.triangle[2] = {0, 4, 9};
  CHECK_THROWS_WITH(collapses_of(mesh), "mesh: triangle 2 has a corner that is no vertex");
  mesh.triangle[2] = {4, 4, 3};
  CHECK_THROWS_WITH(collapses_of(mesh), "mesh: triangle 2 has a corner twice");
  mesh.triangle[2] = {0, 4, 3};
  mesh.vertex_m[7].z() = NAN;
  CHECK_THROWS_WITH(collapses_of(mesh), "mesh: vertex 7 is not finite");
  mesh.vertex_m[7].z() = 0.0F;
  const std::vector<Collapse> twice = {{0, 1}, {0, 3}};
  CHECK_THROWS_WITH(hierarchy_of(mesh, twice), "hierarchy: a collapse names a vertex that is not there");
  CHECK(made_of({}).splits.empty());
}

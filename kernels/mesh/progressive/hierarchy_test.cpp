#include "kernels/mesh/progressive/hierarchy.h"

#include <catch2/catch.hpp>
#include <set>

#include "kernels/mesh/progressive/testing/meshes.h"

using namespace ensonify;
using namespace ensonify::progressive;
using Catch::WithinAbs;

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
  CHECK_THAT(spike.splits[static_cast<std::size_t>(spike.split_of[40])].deviation_m, WithinAbs(0.25F, 0.01));
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

TEST_CASE("a mesh put elsewhere is refined there as it is here") {
  const TriangleMesh mesh = quay_wall(20.0);
  const Hierarchy here = hierarchy_of(mesh, collapses_of(mesh));
  const frames::Vec3 by(400.0, -30.0, -2.0);
  const Hierarchy there = placed(here, by, 0.5 * std::numbers::pi);  // what was north is east
  const auto moved = [&](const frames::Vec3& place) {
    return frames::Vec3(place.y() + 400.0, -place.x() - 30.0, place.z() - 2.0);
  };
  for (std::size_t v = 0; v < mesh.vertex_m.size(); v += 37) {
    const frames::Vec3 place = there.mesh.origin_enu_m + there.mesh.vertex_m[v].cast<double>();
    CHECK((place - moved(mesh.origin_enu_m + mesh.vertex_m[v].cast<double>())).norm() < 1e-5);
  }
  CHECK(fault_of(there).empty());
  Cut of_here(here), of_there(there);
  const frames::Vec3 head(-5.0, -3.0, 4.0);
  of_here.choose(here, std::vector{fan(head, 0.3, 0.0, 25.0)});
  of_there.choose(there, std::vector{fan(moved(head), 0.3 + 0.5 * std::numbers::pi, 0.0, 25.0)});
  CHECK(of_here.triangles().size() > 500);
  // Boxes along the axes stay boxes along the axes; rounding may tip a split at the view's border.
  CHECK(static_cast<double>(of_there.triangles().size()) ==
        Approx(static_cast<double>(of_here.triangles().size())).epsilon(0.01));
}

TEST_CASE("a hierarchy that does not hang together is refused, with its fault") {
  const TriangleMesh mesh = bumpy_ball(20, 10);
  const Hierarchy whole = hierarchy_of(mesh, collapses_of(mesh));
  CHECK(fault_of(whole).empty());
  const auto fault_after = [&](auto damage) {
    Hierarchy hierarchy = whole;
    damage(hierarchy);
    return fault_of(hierarchy);
  };
  CHECK(fault_after([](Hierarchy& h) { h.mesh.vertex_m[3].x() = NAN; }) == "vertex 3 is not finite");
  CHECK(fault_after([](Hierarchy& h) { h.splits[5].parent = 7; }) == "split 5 does not fit the others");
  CHECK(fault_after([](Hierarchy& h) { h.splits[5].removed = 100'000; }) == "split 5 does not fit the others");
  CHECK(fault_after([](Hierarchy& h) { h.splits[5].born = 100'000; }) == "split 5 does not fit the others");
  CHECK(fault_after([](Hierarchy& h) { h.splits[5].kept = h.splits[6].removed; }) ==
        "split 5 goes to a vertex that comes back later");
  CHECK(fault_after([](Hierarchy& h) { h.split_of.pop_back(); }) == "not every vertex has an entry in split_of");
  CHECK(fault_after([](Hierarchy& h) { h.split_of[h.splits.front().kept] = 3; }) != "");
  CHECK(fault_after([](Hierarchy& h) { h.born[0] = h.born[1]; }) == "triangles do not come once each");
  CHECK(fault_after([](Hierarchy& h) { h.coarsest.pop_back(); }) == "triangles do not come once each");
}

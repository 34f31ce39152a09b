#include "components/terrain/mesh_message.h"

#include <catch2/catch.hpp>

#include "kernels/mesh/progressive/hierarchy.h"
#include "kernels/mesh/progressive/objects.h"
#include "messages/codec.h"

using namespace ensonify;

namespace {

progressive::Hierarchy wall() {
  const auto mesh = progressive::mesh_of({.to_enu_m = {12.0, 5.0}}, {1, "wall"});
  return progressive::hierarchy_of(mesh, progressive::collapses_of(mesh));
}

}  // namespace

TEST_CASE("a mesh comes back from its message as it was") {
  const progressive::Hierarchy sent = wall();
  const msg::Body body = msg::encode(mesh_message(sent));
  const progressive::Hierarchy got = hierarchy_of(msg::decode<msg::Mesh>(body, body.size()));
  CHECK(progressive::fault_of(got).empty());
  CHECK(got.mesh.origin_enu_m == sent.mesh.origin_enu_m);
  CHECK(got.mesh.vertex_m == sent.mesh.vertex_m);
  CHECK(got.mesh.triangle == sent.mesh.triangle);
  CHECK(got.born == sent.born);
  CHECK(got.coarsest == sent.coarsest);
  CHECK(got.split_of == sent.split_of);
  REQUIRE(got.splits.size() == sent.splits.size());
  std::size_t different = 0;
  for (std::size_t s = 0; s < got.splits.size(); ++s) {
    const auto &a = got.splits[s], &b = sent.splits[s];
    const bool same = a.removed == b.removed && a.kept == b.kept && a.parent == b.parent && a.child == b.child &&
                      a.first_born == b.first_born && a.born == b.born && a.deviation_m == b.deviation_m &&
                      a.box_m.min() == b.box_m.min() && a.box_m.max() == b.box_m.max();
    different += same ? 0U : 1U;
  }
  CHECK(different == 0);
}

TEST_CASE("a mesh of triangles alone is one without splits") {
  msg::Mesh message = mesh_message(wall());
  message.split = {}, message.split_box_m = {}, message.split_deviation_m = {}, message.born = {};
  message.coarsest = msg::Array<std::uint32_t>({message.triangle.rows()});
  for (std::size_t t = 0; t < message.coarsest.size(); ++t) message.coarsest[t] = static_cast<std::uint32_t>(t);
  const progressive::Hierarchy plain = hierarchy_of(message);
  CHECK(progressive::fault_of(plain).empty());
  CHECK(plain.splits.empty());
}

TEST_CASE("arrays that do not go together are refused") {
  msg::Mesh message = mesh_message(wall());
  message.vertex_m = msg::Array<float>({7, 2});
  CHECK_THROWS_WITH(hierarchy_of(message), "mesh: the shape of vertex_m does not fit");
  message = mesh_message(wall());
  message.split_box_m = msg::Array<float>({1, 6});
  CHECK_THROWS_WITH(hierarchy_of(message), "mesh: the shape of split_box_m does not fit");
  message = mesh_message(wall());
  message.split_deviation_m = {};
  CHECK_THROWS_WITH(hierarchy_of(message), "mesh: the shape of split_deviation_m does not fit");
}

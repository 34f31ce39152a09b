#include "components/terrain_pager/meshes.h"

#include <catch2/catch.hpp>

#include "components/config/config_error.h"
#include "components/runtime/testing/node_under_test.h"
#include "components/terrain_pager/node.h"

using namespace ensonify;
using pager::Meshes;

namespace {

/// Level ground of 400 m, and a wall of 24 m along the east, 100 m east and 50 m north of its middle.
TerrainPagerConfig quay() {
  TerrainPagerConfig config;
  config.scenario_file = "world.yaml";
  config.feed_margin_m = 60.0;
  config.release_hysteresis_m = 20.0;
  config.terrain.seabed.post_spacing_m = 1.0;
  config.terrain.seabed.layered.size_m = {400.0, 400.0};
  SeabedMesh wall{.name = "quay", .wall = progressive::SheetPileWall{}, .sediment = 0};
  wall.wall->from_enu_m = {100.0, 50.0};
  wall.wall->to_enu_m = {124.0, 50.0};
  config.terrain.seabed.meshes = {wall};
  return config;
}

Meshes meshes_of(const TerrainPagerConfig& config) {
  Meshes::Made made;
  return {config, *source::source_of(config.terrain), made};
}
const paging::Margins kMargins{60.0, 80.0};

}  // namespace

TEST_CASE("a mesh is published near the vehicle, and released farther off than that") {
  Meshes meshes = meshes_of(quay());
  const auto update = [&](double east_m) { return meshes.update({east_m, 50.0}, kMargins); };
  CHECK(update(39.0).publish.empty());
  const auto near = update(41.0);
  REQUIRE(near.publish.size() == 1);
  CHECK(near.publish[0]->name == "quay");
  CHECK(near.publish[0]->number == 0);
  CHECK(update(112.0).publish.empty());  // beside it: heads have it
  CHECK(update(21.0).release.empty());
  CHECK(update(19.0).release == std::vector<std::int64_t>{0});
  CHECK(update(10.0).release.empty());
  CHECK(update(60.0).publish.size() == 1);
}

TEST_CASE("a mesh that no head can reach or hold is refused, with its place") {
  TerrainPagerConfig config = quay();
  config.terrain.seabed.meshes[0].wall->from_enu_m = {400.0, 50.0};
  config.terrain.seabed.meshes[0].wall->to_enu_m = {424.0, 50.0};
  CHECK_THROWS_WITH(meshes_of(config),
                    "world.yaml: seabed.meshes.quay: lies at east 400 to 424, north 50 to 50 m, outside the terrain; "
                    "allowed is east -200 to 200, north -200 to 200 m (position_m moves it)");
  config = quay();
  config.head_budget_mb = 0.05;
  CHECK_THROWS_WITH(meshes_of(config), Catch::Contains("world.yaml: seabed.meshes.quay: makes") &&
                                           Catch::Contains("at most 0.05 MB are allowed"));
}

TEST_CASE("a runline through a mesh is refused with its place, one beside or above is not") {
  TerrainPagerConfig config = quay();
  const auto refused = [&](const runlines::Runline& line, double depth_m) {
    config.mission.depth_m = depth_m;
    config.mission.steps = {FollowLine{.points_enu_m = {line.start_enu_m, line.end_enu_m}}};
    try {
      meshes_of(config);
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  config.terrain.seabed.meshes[0].wall->out_of_line_m = 0.0;
  // Pans stand in and out by half the section's depth: the way up from the south hits one of them.
  CHECK_THAT(
      refused({{110.0, 0.0}, {110.0, 90.0}}, 0.0),
      Catch::Matches(R"(world.yaml: mission runline 1: at \(110.0, (49.[89]|50.[0-2])\) m, 0.0 m deep, it runs into )"
                     "the mesh quay; allowed is a way beside it, or above"));
  CHECK_THAT(refused({{110.0, 90.0}, {110.0, 0.0}}, 3.0), Catch::Contains("3.0 m deep"));
  config.mission.run_out_m = 4.0;
  CHECK(refused({{110.0, 0.0}, {110.0, 45.0}}, 0.0).empty());
  config.mission.run_out_m = 6.0;
  CHECK_FALSE(refused({{110.0, 0.0}, {110.0, 45.0}}, 0.0).empty());
  config.mission.run_out_m = 0.0;
  config.mission.run_in_m = 6.0;
  CHECK_FALSE(refused({{110.0, 45.0}, {110.0, 0.0}}, 0.0).empty());
  config.mission.run_in_m = 0.0;
  CHECK(refused({{126.0, 0.0}, {126.0, 90.0}}, 0.0).empty());
  config.mission.steps = {FollowOrbit{.centre_enu_m = {110.0, 30.0}, .radius_m = 19.0}};
  CHECK_NOTHROW(meshes_of(config));
  config.mission.steps = {FollowOrbit{.centre_enu_m = {110.0, 30.0}, .radius_m = 21.0}};
  CHECK_THROWS_WITH(meshes_of(config), Catch::Contains("world.yaml: mission orbit: at"));
  config.terrain.seabed.meshes[0].wall->top_height_m = -2.0;
  CHECK(refused({{110.0, 0.0}, {110.0, 90.0}}, 1.9).empty());
  CHECK_FALSE(refused({{110.0, 0.0}, {110.0, 90.0}}, 2.0).empty());
}

TEST_CASE("the pager publishes a mesh in the event in which it publishes the tiles there") {
  NodeUnderTest<TerrainPagerNode> node(quay());
  for (int s = 0; s <= 20; ++s) {
    msg::Pose pose;
    pose.stamp_ns = SimTime(std::chrono::seconds(s)).count();
    pose.position_enu_m = {20.0 + 5.0 * s, 50.0, 0.0};
    node.give("pose", pose);
  }
  CHECK(node.step_until<msg::Mesh>("mesh", 3_s).empty());
  const auto meshes = node.step_until<msg::Mesh>("mesh", 20_s);
  REQUIRE(meshes.size() == 1);
  CHECK(meshes[0].name == "quay");
  CHECK(meshes[0].vertex_m.rows() == meshes[0].vertex_m.size() / 3);
  CHECK(node.step_until<msg::MeshRelease>("mesh_release", 20_s).empty());
}

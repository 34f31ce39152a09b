#include "components/terrain_pager/objects.h"

#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <string>

#include "components/config/config_error.h"
#include "components/runtime/testing/node_under_test.h"
#include "components/terrain/object_message.h"
#include "components/terrain_pager/node.h"

using namespace ensonify;
using Catch::Matchers::WithinAbs;

namespace {

/// Level ground of 400 m, 20 m deep, and a ball on it 100 m east and 50 m north of its middle.
TerrainPagerConfig with_ball() {
  TerrainPagerConfig config;
  config.feed_margin_m = 60.0;
  config.release_hysteresis_m = 20.0;
  config.terrain.seabed.post_spacing_m = 1.0;
  config.terrain.seabed.layered.size_m = {400.0, 400.0};
  SceneObject ball{.name = "ball", .class_name = "mine", .class_id = 3, .instance = 5, .solid = solids::Sphere{0.5}};
  ball.place.position_enu_m = {100.0, 50.0, 0.0};
  ball.place.buried_share = 0.0;
  ball.smooth = true;
  ball.written = {"world.yaml", 7, 3};
  config.objects = {ball};
  return config;
}

/// Objects and the ground on which they stand.
struct OnGround {
  explicit OnGround(const TerrainPagerConfig& config)
      : terrain(source::source_of(config.terrain)), objects(config, *terrain) {}

  std::shared_ptr<const source::TerrainSource> terrain;
  pager::Objects objects;
};
const paging::Margins kMargins{60.0, 80.0};

msg::Object placed(const TerrainPagerConfig& config) {
  OnGround ground(config);
  return *ground.objects.update({100.0, 50.0}, kMargins).publish.at(0);
}

std::string refusal(const TerrainPagerConfig& config) {
  try {
    OnGround{config};
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("an object is published near the vehicle, and released farther off than that") {
  OnGround ground(with_ball());
  const auto update = [&](double east_m) { return ground.objects.update({east_m, 50.0}, kMargins); };
  CHECK(update(39.0).publish.empty());
  const auto near = update(41.0);
  REQUIRE(near.publish.size() == 1);
  CHECK(near.publish[0]->number == 4);
  CHECK(near.publish[0]->instance == 5);
  CHECK(near.publish[0]->class_id == 3);
  CHECK(near.publish[0]->class_name == "mine");
  CHECK(near.publish[0]->smooth);
  CHECK(update(112.0).publish.empty());
  CHECK(update(19.0).release == std::vector<std::int64_t>{4});
  CHECK(update(60.0).publish.size() == 1);
}

TEST_CASE("on the seabed an object stands as deep as its burial says") {
  TerrainPagerConfig config = with_ball();
  CHECK_THAT(placed(config).position_enu_m[2], WithinAbs(-20.0 + 0.25, 1e-3));
  config.objects[0].place.buried_share = 0.5;
  CHECK_THAT(placed(config).position_enu_m[2], WithinAbs(-20.0, 1e-3));
  // Of a ball a fifth lies below h with h^2 (3 a - h) = 4/5 a^3: h = 0.2871 diameters.
  config.objects[0].place.buried_share = 0.2;
  CHECK_THAT(placed(config).position_enu_m[2], WithinAbs(-20.0 + 0.25 - 0.2871 * 0.5, 2e-3));
  // A cylinder that lies, and the same on its end.
  config.objects[0].place.buried_share = 0.0;
  config.objects[0].solid = solids::Cylinder{0.5, 2.0};
  CHECK_THAT(placed(config).position_enu_m[2], WithinAbs(-20.0 + 0.25, 5e-3));
  config.objects[0].place.tilt_rad = 0.5 * std::numbers::pi;  // to the north, as its axis lies
  CHECK_THAT(placed(config).position_enu_m[2], WithinAbs(-20.0 + 1.0, 1e-3));
}

TEST_CASE("an object that rests lies on its ground") {
  TerrainPagerConfig config = with_ball();
  config.objects[0].place.buried_share.reset();
  config.objects[0].place.rests = true;
  config.objects[0].solid = solids::Box{{1.0, 0.6, 0.4}};
  CHECK_THAT(placed(config).position_enu_m[2], WithinAbs(-20.0 + 0.2, 1e-6));
  // Upright and balanced on an edge it falls to a side.
  config.objects[0].solid = solids::Cone{0.2, 0.0, 1.5};
  config.objects[0].place.tilt_rad = std::numbers::pi;
  const auto fallen = frames::quaternion_of(placed(config).enu_from_object).toRotationMatrix();
  CHECK(std::abs(fallen(2, 2)) < 0.2);
}

TEST_CASE("many objects are placed when the vehicle comes near, in the scenario's order") {
  TerrainPagerConfig config = with_ball();
  for (std::uint32_t i = 0; i < pager::Objects::kPlacedAtOnce; ++i) {
    config.objects.push_back(config.objects[0]);
    config.objects.back().instance = 6 + i;
    config.objects.back().place.position_enu_m = {-190.0 + 0.7 * i, -50.0, 0.0};
  }
  config.objects[7].place.position_enu_m.x() = 500.0;  // outside, and never near
  OnGround ground(config);
  CHECK(ground.objects.update({-190.0, -100.0}, kMargins).publish.size() ==
        48);  // of 33 m, but the one that is elsewhere
  const auto next = ground.objects.update({-150.0, -100.0}, kMargins);
  REQUIRE(next.publish.size() > 40);
  CHECK(std::ranges::is_sorted(next.publish, {}, &msg::Object::number));
  CHECK_THAT(next.publish[0]->position_enu_m[2], WithinAbs(-19.75, 1e-3));
  CHECK_THROWS_WITH(ground.objects.update({480.0, -40.0}, kMargins), Catch::Contains("outside the terrain"));
}

TEST_CASE("objects of one file share its mesh, which comes before them and once") {
  const auto path = std::filesystem::temp_directory_path() / ("objects_test_" + std::to_string(getpid()) + ".off");
  std::ofstream(path) << "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  TerrainPagerConfig config = with_ball();
  config.objects[0].solid = solids::Mesh{nullptr, false, 2.0};
  config.objects[0].file = ObjectFile{path, {}, false};
  config.objects.push_back(config.objects[0]);
  config.objects[1].instance = 6;
  config.objects[1].solid = solids::Mesh{nullptr, false, 3.0};
  NodeUnderTest<TerrainPagerNode> node(config);
  std::filesystem::remove(path);
  msg::Pose pose;
  pose.position_enu_m = {90.0, 50.0, -1.0};
  node.give("pose", pose);
  const auto meshes = node.step_until<msg::ObjectMesh>("object_mesh", 2_s);
  const auto objects = node.step_until<msg::Object>("object", 2_s);
  REQUIRE(meshes.size() == 1);
  REQUIRE(objects.size() == 2);
  CHECK(meshes[0].closed);
  CHECK(objects[0].shape == "mesh");
  CHECK(objects[1].mesh == meshes[0].number);
  const solids::Mesh mesh = mesh_of(meshes[0]);
  const auto volume_m3 = [&](const msg::Object& object) {
    return solids::volume_below_m3(surface_of(object, solid_of(object, &mesh), 1e-3).mesh, 100.0);
  };
  CHECK(volume_m3(objects[0]) == Approx(8.0 / 6.0).epsilon(1e-4));
  CHECK(volume_m3(objects[1]) == Approx(27.0 / 6.0).epsilon(1e-4));
  CHECK_THROWS_WITH(solid_of(objects[0]), "object ball: its mesh has not come");
}

TEST_CASE("an object that hangs stays where the scenario has it") {
  TerrainPagerConfig config = with_ball();
  config.objects[0].place.buried_share.reset();
  config.objects[0].place.position_enu_m.z() = -12.5;
  CHECK(placed(config).position_enu_m == std::array<double, 3>{100.0, 50.0, -12.5});
}

TEST_CASE("an object in an impossible place is refused, with its line") {
  TerrainPagerConfig config = with_ball();
  config.objects[0].place.position_enu_m.x() = 300.0;
  CHECK(refusal(config) ==
        "world.yaml:7:3: objects.ball: stands at (300, 50) m, outside the terrain; allowed is east -200 to 200, north "
        "-200 to 200 m");
  config = with_ball();
  config.objects[0].place.buried_share.reset();
  CHECK(
      refusal(config) ==
      "world.yaml:7:3: objects.ball: reaches 0.25 m above chart datum, and the water falls to 0.00 m; allowed is what "
      "stays below the water");
  config.objects[0].place.position_enu_m.z() = -21.0;
  CHECK(refusal(config) ==
        "world.yaml:7:3: objects.ball: lies below the seabed, which is at -20.00 m there and it ends at -20.75 m; "
        "allowed is what shows something above it");
  config.objects[0].place.position_enu_m.z() = -0.3;
  config.mission.depth_m = 1.0;
  config.mission.steps = {FollowLine{.points_enu_m = {{100.0, 0.0}, {100.0, 90.0}}}};
  CHECK_THAT(refusal(config), Catch::Contains("it runs into the object ball"));
}

TEST_CASE("the pager publishes the objects near the vehicle") {
  NodeUnderTest<TerrainPagerNode> node(with_ball());
  msg::Pose pose;
  pose.position_enu_m = {90.0, 50.0, -1.0};
  node.give("pose", pose);
  const auto objects = node.step_until<msg::Object>("object", 2_s);
  REQUIRE(objects.size() == 1);
  CHECK(objects[0].name == "ball");
  CHECK_THAT(objects[0].position_enu_m[2], WithinAbs(-19.75, 1e-3));
}

#include "scenarios/world/objects.h"

#include <catch2/catch.hpp>
#include <numbers>
#include <string>

#include "components/config/config_reader.h"
#include "scenarios/world/world.h"

namespace ensonify {
namespace {

const std::string kRest =
    "ensonify: scenario/1\nsite: {latitude_deg: 1, longitude_deg: 2}\nseabed: {kind: layers, sediments: {0: fine sand, "
    "4: "
    "cobble}}\nmission: {runlines: [{from_m: [0, 0], to_m: [0, 9]}]}\nobjects:\n";

World world_of(const std::string& objects) {
  auto from = ConfigReader::from_text(kRest + objects, "s.yaml");
  World world = read_world(from, "s.yaml");
  from.finish();
  return world;
}

std::string problems_of(const std::string& object) {
  try {
    world_of("  a: {" + object + "}\n");
    return "";
  } catch (const ConfigError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("objects are read, numbered, and their classes too") {
  const World world = world_of(
      "  mine: {class: mine, cylinder: {diameter_m: 0.5, length_m: 2}, on_seabed: {at_m: [12, 40], burial: 0.2}, "
      "heading_deg: 60, sediment: 4}\n"
      "  ball: {sphere: {diameter_m: 0.3}, position_m: [1, 2, -8], material: smooth}\n"
      "  other: {class: mine, box: {size_m: [1, 0.6, 0.5]}, on_seabed: {at_m: [0, 0]}, tilt_deg: 20, tilt_heading_deg: "
      "90}\n"
      "  sheet: {plate: {size_m: [1, 2]}, position_m: [0, 0, -5]}\n");
  REQUIRE(world.objects.size() == 4);
  const SceneObject &mine = world.objects[0], &ball = world.objects[1], &other = world.objects[2];
  CHECK(mine.name == "mine");
  CHECK(std::get<solids::Cylinder>(mine.solid).length_m == 2.0);
  CHECK(mine.place.buried_share == 0.2);
  CHECK(mine.place.position_enu_m.head<2>() == frames::Vec2(12, 40));
  CHECK(mine.place.heading_rad == Approx(std::numbers::pi / 3));
  CHECK(mine.sediment == 4);
  CHECK_FALSE(mine.smooth);
  CHECK(ball.smooth);
  CHECK_FALSE(ball.place.buried_share);
  CHECK(ball.place.position_enu_m == frames::Vec3(1, 2, -8));
  CHECK(ball.class_name == "sphere");
  CHECK(std::vector{mine.class_id, ball.class_id, other.class_id} == std::vector<std::uint32_t>{1, 2, 1});
  CHECK(std::vector{mine.instance, ball.instance, other.instance} == std::vector<std::uint32_t>{1, 2, 3});
  CHECK(other.place.buried_share == 0.0);
  // Its upright leans to the east.
  CHECK((other.place.enu_from_object().col(2) -
         frames::Vec3(std::sin(20 * std::numbers::pi / 180), 0, std::cos(20 * std::numbers::pi / 180)))
            .norm() < 1e-12);
  // The cylinder's axis points 60 degrees east of north.
  CHECK((mine.place.enu_from_object().col(1) - frames::Vec3(std::sqrt(0.75), 0.5, 0)).norm() < 1e-12);
  CHECK(std::string(shape_of(world.objects[3].solid)) == "plate");
}

TEST_CASE("objects with a mistake are refused with their place") {
  CHECK(problems_of("on_seabed: {at_m: [0, 0]}") == "s.yaml:6:6: objects.a: needs one of sphere, box, cylinder, plate");
  CHECK(problems_of("sphere: {diameter_m: 1}") == "s.yaml:6:6: objects.a: needs one of on_seabed, position_m");
  CHECK(problems_of("sphere: {diameter_m: 1}, box: {size_m: [1, 1, 1]}, position_m: [0, 0, -5]") ==
        "s.yaml:6:37: objects.a.box: stands beside sphere; give one shape");
  CHECK(problems_of("sphere: {diameter_m: 1}, position_m: [0, 0, -5], on_seabed: {at_m: [0, 0]}") ==
        "s.yaml:6:44: objects.a.position_m: stands beside on_seabed; give one or the other");
  CHECK(problems_of("sphere: {diameter_m: 0}, position_m: [0, 0, -5]") ==
        "s.yaml:6:28: objects.a.sphere.diameter_m: 0 is outside [0.001, 1000]");
  CHECK(problems_of("sphere: {diameter_m: 1}, position_m: [0, 0, -5], sediment: 3") ==
        "s.yaml:6:66: objects.a.sediment: is not a class of seabed.sediments");
  CHECK(problems_of("sphere: {diameter_m: 1}, position_m: [0, 0, -5], material: shiny") ==
        "s.yaml:6:66: objects.a.material: is \"shiny\", not one of diffuse, smooth");
  CHECK(problems_of("sphere: {diameter_m: 1}, on_seabed: {at_m: [0, 0], burial: 1.2}") ==
        "s.yaml:6:66: objects.a.on_seabed.burial: 1.2 is outside [0, 1]");
}

}  // namespace ensonify

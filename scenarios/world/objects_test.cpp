#include "scenarios/world/objects.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>

#include "components/config/config_reader.h"
#include "kernels/mesh/solids/words.h"
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
  CHECK(world.objects[3].class_name == "plate");
}

TEST_CASE("what lies on the seabed without burial and tilt lies in balance") {
  const World world = world_of(
      "  rests: {box: {size_m: [1, 1, 1]}, on_seabed: {at_m: [0, 0]}, heading_deg: 30}\n"
      "  buried: {box: {size_m: [1, 1, 1]}, on_seabed: {at_m: [0, 0], burial: 0}}\n"
      "  tilted: {box: {size_m: [1, 1, 1]}, on_seabed: {at_m: [0, 0]}, tilt_deg: 0}\n"
      "  hangs: {box: {size_m: [1, 1, 1]}, position_m: [0, 0, -5]}\n");
  CHECK(world.objects[0].place.rests);
  CHECK_FALSE(world.objects[0].place.buried_share);
  for (const int i : {1, 2}) {
    CHECK_FALSE(world.objects[i].place.rests);
    CHECK(world.objects[i].place.buried_share == 0.0);
  }
  CHECK_FALSE(world.objects[3].place.rests);
}

TEST_CASE("every shape is read with its sizes, and has its word for a class") {
  const auto sizes = [](const std::string& shape) {
    const SceneObject object = world_of("  a: {" + shape + ", on_seabed: {at_m: [0, 0]}}\n").objects.at(0);
    CHECK(object.class_name == shape.substr(0, shape.find(':')));
    CHECK(object.class_name == solids::word_of(object.solid));
    CHECK(solids::solid_of(object.class_name, solids::sizes_of(object.solid))->index() == object.solid.index());
    return solids::sizes_of(object.solid);
  };
  using Sizes = std::array<double, 3>;
  CHECK(sizes("cone: {diameter_m: 1, height_m: 2}") == Sizes{1, 0, 2});
  CHECK(sizes("tyre: {}") == Sizes{0.65, 0.2, 0});
  CHECK(sizes("pipe: {diameter_m: 0.5, length_m: 6, wall_m: 0.02}") == Sizes{0.5, 6, 0.02});
  CHECK(sizes("bottle: {}") == Sizes{0.08, 0.3, 0});
  CHECK(sizes("shell: {diameter_m: 0.2}") == Sizes{0.2, 0.7, 0});
  CHECK(sizes("wedge: {size_m: [1, 2, 0.5]}") == Sizes{1, 2, 0.5});
  CHECK(sizes("cable: {diameter_m: 0.1, length_m: 6, sag_m: 0.5}") == Sizes{0.1, 6, 0.5});
  CHECK(sizes("chain: {wire_m: 0.04, length_m: 3}") == Sizes{0.04, 3, 0});
  CHECK(sizes("ladder: {}") == Sizes{0.45, 3, 0.06});
  for (const char* figure : {"trap", "anchor", "mooring", "person", "boat", "aircraft", "propeller", "net", "hook",
                             "valve", "sheet_piles", "wreck", "broken_aircraft"})
    CHECK(sizes(std::string(figure) + ": {size_m: [1, 2, 3]}") == Sizes{1, 2, 3});
}

TEST_CASE("objects are strewn by the scenario's seed") {
  const std::string mines =
      "  mines: {class: mine, cylinder: {diameter_m: 0.5, length_m: 2}, strewn: {count: 200, from_m: [-100, 0], "
      "to_m: [100, 0], width_m: 60, apart_m: 3, scale: [0.5, 2], heading_deg: [0, 90], burial: [0.1, 0.4]}}\n";
  const World world = world_of(mines + "  last: {sphere: {diameter_m: 1}, on_seabed: {at_m: [0, 0]}}\n");
  REQUIRE(world.objects.size() == 201);
  CHECK(world.objects[0].name == "mines_1");
  CHECK(world.objects[199].name == "mines_200");
  CHECK(world.objects[200].instance == 201);
  CHECK(world.objects[200].class_id == 2);
  double least_apart_m = 1e9, smallest_m = 1e9, largest_m = 0.0;
  for (std::size_t i = 0; i < 200; ++i) {
    const SceneObject& mine = world.objects[i];
    const auto place = mine.place.position_enu_m.head<2>();
    CHECK(std::abs(place.x()) <= 100.0);
    CHECK(std::abs(place.y()) <= 30.0);
    CHECK(mine.place.heading_rad >= 0.0);
    CHECK(mine.place.heading_rad <= std::numbers::pi / 2);
    CHECK(mine.place.buried_share.value() >= 0.1);
    CHECK(mine.place.buried_share.value() <= 0.4);
    const auto& cylinder = std::get<solids::Cylinder>(mine.solid);
    CHECK(cylinder.length_m == Approx(4.0 * cylinder.diameter_m));
    smallest_m = std::min(smallest_m, cylinder.diameter_m), largest_m = std::max(largest_m, cylinder.diameter_m);
    for (std::size_t j = 0; j < i; ++j)
      least_apart_m = std::min(least_apart_m, (world.objects[j].place.position_enu_m.head<2>() - place).norm());
  }
  CHECK(least_apart_m >= 3.0);
  CHECK(smallest_m >= 0.25);
  CHECK(smallest_m < 0.3);
  CHECK(largest_m <= 1.0);
  CHECK(largest_m > 0.9);
  CHECK(world_of(mines).objects[7].place.position_enu_m == world.objects[7].place.position_enu_m);
  CHECK(
      world_of("  x: {sphere: {diameter_m: 1}, on_seabed: {at_m: [0, 0]}}\n" + mines).objects[8].place.position_enu_m ==
      world.objects[7].place.position_enu_m);  // others do not move them
}

TEST_CASE("more objects than there is room for are a problem") {
  CHECK(problems_of(
            "sphere: {diameter_m: 1}, strewn: {count: 100, from_m: [0, 0], to_m: [10, 0], width_m: 1, apart_m: 2}")
            .find("objects.a.strewn.apart_m: keeps ") != std::string::npos);
  CHECK(problems_of(
            "sphere: {diameter_m: 1}, strewn: {count: 1, from_m: [0, 0], to_m: [10, 0], width_m: 1, scale: [2, 1]}")
            .find("objects.a.strewn.scale: falls; allowed is [least, most]") != std::string::npos);
}

TEST_CASE("a laid cable has sections as long as each other, each an instance") {
  const World world = world_of(
      "  wire: {cable: {diameter_m: 0.1}, laid: {through_m: [[0, 0], [6, 8], [6, 10]], taut_m: 40, section_m: 5}}\n"
      "  ball: {sphere: {diameter_m: 0.3}, position_m: [1, 2, -8]}\n");
  REQUIRE(world.objects.size() == 4);
  CHECK(world.objects[0].name == "wire_1");
  CHECK(world.objects[2].laid->from_m == Approx(8.0));
  CHECK(world.objects[2].laid->to_m == Approx(12.0));
  CHECK((world.objects[2].place.position_enu_m.head<2>() - frames::Vec2(6, 8)).norm() < 1e-9);
  CHECK(world.objects[1].laid->route == world.objects[0].laid->route);
  CHECK(world.objects[0].class_name == "cable");
  CHECK(world.objects[3].instance == 4);
}

TEST_CASE("laid lines with a mistake are refused with their place") {
  const auto says = [](const std::string& object, const std::string& what) {
    CAPTURE(object, problems_of(object));
    CHECK(problems_of(object).find(what) != std::string::npos);
  };
  says("cable: {diameter_m: 0.1}, laid: {through_m: [[0, 0]]}", "objects.a.laid.through_m: has fewer than two places");
  says("cable: {diameter_m: 0.1}, laid: {through_m: [[0, 0], [1, 0], [1, 0]]}", "has places 2 and 3 within 0.01 m");
  says("cable: {diameter_m: 0.1}, laid: {through_m: [[0, 0], [3000, 0]], section_m: 0.1}", "makes 30000 sections");
  says("cable: {diameter_m: 0.1}, position_m: [0, 0, -5]", "objects.a: needs length_m");
  says("cable: {diameter_m: 0.1, length_m: 4}, laid: {through_m: [[0, 0], [1, 0]]}", "allowed: no length_m, no sag_m");
  says("chain: {wire_m: 0.001, length_m: 100}, position_m: [0, 0, -5]",
       "objects.a.chain.wire_m: 0.001 makes 25000 links");
  says("chain: {wire_m: 0.001}, laid: {through_m: [[0, 0], [9, 0]], section_m: 9}", "makes 2250 links");
  says("sphere: {diameter_m: 0.1}, laid: {through_m: [[0, 0], [1, 0]]}",
       "is for a cable or a chain, and it is a sphere");
}

TEST_CASE("objects with a mistake are refused with their place") {
  CHECK(
      problems_of("on_seabed: {at_m: [0, 0]}") ==
      "s.yaml:6:6: objects.a: needs one of sphere, box, cylinder, plate, cone, tyre, pipe, bottle, "
      "shell, wedge, cable, chain, ladder, trap, anchor, mooring, person, boat, aircraft, propeller, net, hook, valve, "
      "sheet_piles, wreck, broken_aircraft, mesh");
  CHECK(problems_of("sphere: {diameter_m: 1}") ==
        "s.yaml:6:6: objects.a: needs one of on_seabed, position_m, strewn, laid");
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
  CHECK(problems_of("tyre: {diameter_m: 0.3, width_m: 0.2}, position_m: [0, 0, -5]") ==
        "s.yaml:6:26: objects.a.tyre.diameter_m: 0.3 is not above twice its width_m of 0.2");
  CHECK(problems_of("pipe: {diameter_m: 0.3, length_m: 2, wall_m: 0.2}, position_m: [0, 0, -5]") ==
        "s.yaml:6:52: objects.a.pipe.wall_m: 0.2 leaves no bore in diameter_m 0.3; allowed: less than half of it");
  CHECK(problems_of("shell: {diameter_m: 0.4, length_m: 0.5}, position_m: [0, 0, -5]") ==
        "s.yaml:6:42: objects.a.shell.length_m: 0.5 is not above 1.25 of its diameter_m of 0.4");
  CHECK(problems_of("sphere: {diameter_m: 1}, on_seabed: {at_m: [0, 0], burial: 1.2}") ==
        "s.yaml:6:66: objects.a.on_seabed.burial: 1.2 is outside [0, 1]");
}

}  // namespace ensonify

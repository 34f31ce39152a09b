#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "components/config/config_node.h"
#include "components/config/config_text.h"
#include "components/config/parse_yaml.h"
#include "components/terrain_pager/mission_track.h"

using namespace ensonify;
using namespace ensonify::pager;

namespace {

constexpr const char* kWorld = R"(vehicles:
  boat: { start: { position_m: [0, 0, 0] } }
  tender: {}
mission:
  speed_mps: 2
  steps:
    - { mark: begin }
    - { line: [[0, 0], [0, 50], [0, 90]] }
    - { line: [[9, 0], [9, 50]] }
)";

/// The places in a scenario file of that text; `in_force`, what a launch made of it.
MissionPlaces places_of(const std::string& text, const std::string& in_force) {
  const auto file = std::filesystem::temp_directory_path() / "ensonify_mission_places.yaml";
  std::ofstream(file) << text;
  return mission_places(file.string(), to_canonical_yaml(parse_config(in_force, "run").root));
}

}  // namespace

TEST_CASE("each step stands where the file has it, and a vehicle's start where it is given") {
  const MissionPlaces places = places_of(kWorld, kWorld);
  CHECK(places.mission.line == 5);
  CHECK(places.start("boat").line == 2);
  CHECK(places.step(0).line == 7);
  CHECK(places.step(1).line == 8);
  CHECK(places.step(2).line == 9);
}

TEST_CASE("lines laid out by a rule stand where the rule does") {
  const std::string world = "mission:\n  speed_mps: 2\n  lawnmower: { length_m: 9, spacing_m: 9, count: 3 }\n";
  const MissionPlaces places = places_of(world, world);
  CHECK(places.step(0).line == 3);
  CHECK(places.step(2).line == 3);
}

TEST_CASE("a mission's own file is looked for beside the scenario that names it") {
  const auto folder = std::filesystem::temp_directory_path() / "ensonify_mission_places";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "plan.yaml") << "ensonify: mission/1\nrunlines: [{from_m: [0, 0], to_m: [0, 9]}]\n";
  std::ofstream(folder / "under.yaml") << "ensonify: scenario/1\nmission: {file: plan.yaml}\n";
  const MissionPlaces places =
      places_of("ensonify: scenario/1\ninclude: ensonify_mission_places/under.yaml\n", "mission: {file: plan.yaml}\n");
  CHECK(places.step(0).file == (folder / "plan.yaml").string());
  CHECK(places.step(0).line == 2);
}

TEST_CASE("what a launch has changed does not stand in the scenario's file") {
  std::string changed = kWorld;
  changed.replace(changed.find("9, 50"), 5, "9, 60");
  const MissionPlaces places = places_of(kWorld, changed);
  CHECK(places.step(1).line == 0);
  CHECK(places.start("boat").line == 2);  // and what it has not, does
}

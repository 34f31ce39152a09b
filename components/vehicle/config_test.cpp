#include "components/vehicle/config.h"

#include <catch2/catch.hpp>
#include <cstdlib>

using namespace ensonify;

namespace {

World two_vehicles() {
  World world;
  world.file = "bay.yaml";
  world.mission.runlines = {{{0, 0}, {0, 100}}};
  Vehicle auv, ship;
  auv.name = "auv";
  ship.name = "ship";
  ship.limits.turning_radius_m = 40;
  world.vehicles = {auv, ship};
  return world;
}

std::string problem(const std::string& yaml, const World& world, const std::string& process) {
  auto from = ConfigReader::from_text(yaml, "v.yaml");
  VehicleConfig::read(from, world, process);
  try {
    from.finish();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a process finds its vehicle by its own name or by the key") {
  const World world = two_vehicles();
  auto by_name = ConfigReader::from_text("{}", "v.yaml");
  CHECK(VehicleConfig::read(by_name, world, "ship").limits.turning_radius_m == 40);
  auto by_key = ConfigReader::from_text("vehicle: ship", "v.yaml");
  CHECK(VehicleConfig::read(by_key, world, "auv").limits.turning_radius_m == 40);
  CHECK(problem("{}", world, "rov") ==
        "v.yaml:1:1: vehicle: is missing, and no vehicle is named rov; allowed: auv, ship");
  CHECK(problem("vehicle: shup", world, "auv") ==
        "v.yaml:1:10: vehicle: \"shup\" is no vehicle of the scenario; allowed: auv, ship");
  CHECK(problem("{}", World{}, "auv").find("has no vehicle") != std::string::npos);
}

TEST_CASE("what a vehicle's forces cannot do of a mission is refused") {
  World world = two_vehicles();
  world.vehicles.pop_back();
  Vehicle& auv = world.vehicles[0];
  auv.dynamics_file = std::string(std::getenv("ENSONIFY_FOLDER")) + "/hydrodynamic/remus_100.yaml";
  auv.limits.turning_radius_m = 25;
  world.mission.speed_mps = 2;
  CHECK(problem("{}", world, "auv") == "");
  auv.limits.turning_radius_m = 5;
  CHECK(problem("{}", world, "auv") ==
        "v.yaml:1:1: the scenario has auv turn on 5 m at 2 m/s, tighter than its forces make; allowed: "
        "turning_radius_m 19.5 or more");
  world.mission.steps = {GoAt{4.0, {}, {}}};
  CHECK(problem("{}", world, "auv") ==
        "v.yaml:1:1: the mission asks for 4 m/s, more than auv's propellers make; allowed: 2.55 m/s");
  auv.start.emplace();  // somebody else may be the one that is steered
  world.vehicles.push_back(two_vehicles().vehicles[1]);
  CHECK(problem("{}", world, "auv") == "");
}

TEST_CASE("a vehicle without a start begins the first line's run-in at mission speed") {
  World world = two_vehicles();
  world.mission.run_in_m = 15;
  world.mission.depth_m = 4;
  world.mission.speed_mps = 1.5;
  auto from = ConfigReader::from_text("{}", "v.yaml");
  const auto start = VehicleConfig::read(from, world, "auv").start;
  REQUIRE(start.has_value());
  CHECK((start->position_enu_m - frames::Vec3(0, -15, -4)).norm() < 1e-9);
  CHECK(start->heading_rad == Approx(0.0));
  CHECK(start->speed_mps == 1.5);
}

#include "scenarios/world/world.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "components/config/config_reader.h"

using Catch::WithinAbs;

namespace ensonify {
namespace {

const std::string kBay = R"(ensonify: scenario/1
site: {name: Bay, latitude_deg: 42.5, longitude_deg: -70.5}
time: {start_utc: "2025-06-01T12:00:00Z"}
seed: 7
water: {temperature_degc: 12, absorption_db_per_km: 60}
seabed:
  kind: layers
  layers: {slope: {plane: {slope_deg: 2}}, rocks: {boulders: {per_km2: 900, smallest_radius_m: 1, largest_radius_m: 2}}}
vehicles:
  auv:
    kind: kinematic
    turning_radius_m: 12
    roll: {amplitude_deg: 3, period_s: 7}
    mountings:
      bow: {actual: {position_m: [1, 0.5, 0.2], roll_deg: 90}, measured: {position_m: [1, 0.5, 1.2]}}
      stern: {actual: {heading_deg: 180}}
mission: {speed_kn: 4, lawnmower: {centre_m: [0, 0], length_m: 200, spacing_m: 50, count: 3}}
)";

World scenario_of(const std::string& text) {
  auto from = ConfigReader::from_text(text, "bay.yaml");
  const World world = read_world(from, "bay.yaml");
  from.finish();
  return world;
}

std::string problems_of(std::string text, const std::string& old_part, const std::string& new_part) {
  const auto at = text.find(old_part);
  REQUIRE(at != std::string::npos);
  try {
    scenario_of(text.replace(at, old_part.size(), new_part));
    return "";
  } catch (const ConfigError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("a scenario is read whole, in SI units") {
  const World bay = scenario_of(kBay);
  CHECK(bay.site.origin.latitude_deg == 42.5);
  CHECK(bay.start_unix_ns == 1748779200000000000);
  CHECK(bay.seed == 7);
  CHECK(bay.water.absorption_dbpm == Approx(0.06));
  CHECK_FALSE(bay.water.profile.given());
  REQUIRE(bay.seabed.layered.layers.size() == 2);
  CHECK(std::get<relief::Plane>(bay.seabed.layered.layers[0].form).slope ==
        Approx(std::tan(2 * 3.14159265358979 / 180)));
  CHECK(bay.seabed.layered.layers[1].name == "rocks");
  CHECK(std::get<relief::BodyParameters>(bay.seabed.layered.layers[1].form).per_km2 == 900);
  CHECK(bay.seabed.layered.seed == 7);
  CHECK_THAT(bay.mission.speed_mps, WithinAbs(4 * 0.514444, 1e-5));
  CHECK(bay.vehicle().limits.turning_radius_m == 12);
  CHECK(bay.vehicle().limits.turn_acceleration_radps2 == Approx(10 * 3.14159265358979 / 180));
  CHECK(bay.vehicle().limits.vertical_acceleration_mps2 == 0.2);
  CHECK(bay.vehicle("auv").waves.roll_rad.period_s == 7);
  CHECK_FALSE(bay.vehicle().start.has_value());
  CHECK_THROWS_AS(bay.vehicle("usv"), std::out_of_range);
}

TEST_CASE("a lawnmower of three lines runs up, down, up") {
  const World bay = scenario_of(kBay);
  REQUIRE(bay.mission.runlines.size() == 3);
  CHECK_THAT(runlines::heading_rad(bay.mission.runlines[0]), WithinAbs(0, 1e-12));
  CHECK(runlines::heading_rad(bay.mission.runlines[1]) == Approx(3.14159265358979));
  CHECK(bay.mission.runlines[0].start_enu_m.x() == Approx(-50));
}

TEST_CASE("a measured mounting starts from the actual one and differs where it says so") {
  const auto bow = scenario_of(kBay).mounting("bow");
  REQUIRE(bow.has_value());
  CHECK(bow->first == "auv");
  CHECK(bow->second.actual.position_body_m.z() == 0.2);
  CHECK(bow->second.measured.position_body_m.z() == 1.2);
  CHECK(bow->second.measured.body_from_head.isApprox(bow->second.actual.body_from_head));
  // Rolled by 90 degrees to starboard down: the head's down axis points to port, its starboard axis down.
  const frames::Vec3 down_axis = bow->second.actual.body_from_head * frames::Vec3::UnitZ();
  CHECK((down_axis - frames::Vec3(0, -1, 0)).norm() < 1e-12);
  const auto stern = scenario_of(kBay).mounting("stern");
  CHECK((stern->second.actual.body_from_head * frames::Vec3::UnitX() + frames::Vec3::UnitX()).norm() < 1e-12);
  CHECK_FALSE(scenario_of(kBay).mounting("keel").has_value());
}

TEST_CASE("lines can be laid over a generated seabed too") {
  std::string text = kBay;
  const std::string lines = "lawnmower: {centre_m: [0, 0], length_m: 200, spacing_m: 50, count: 3}";
  text.replace(text.find(lines), lines.size(), "auto: {count: 2}");
  const World world = scenario_of(text);
  REQUIRE(world.mission.auto_plan);
  CHECK(world.mission.auto_plan->count == 2);
}

TEST_CASE("mistakes in a scenario have a place, a key and what is allowed") {
  CHECK(problems_of(kBay, "scenario/1", "scenario/2") ==
        "bay.yaml:1:11: ensonify: scenario/2 is not a format known here; allowed: scenario/1");
  CHECK(problems_of(kBay, "scenario/1", "launch/1") ==
        "bay.yaml:1:11: ensonify: launch/1 is not a format known here; allowed: scenario/1");
  CHECK(problems_of(kBay, "latitude_deg: 42.5", "latitude_deg: 142.5") ==
        "bay.yaml:2:33: site.latitude_deg: 142.5 is outside [-89.9, 89.9]");
  CHECK(problems_of(kBay, "2025-06-01", "2025-02-30") ==
        "bay.yaml:3:19: time.start_utc: \"2025-02-30T12:00:00Z\" is not a UTC time such as 2025-06-01T12:00:00Z");
  CHECK(problems_of(kBay, "kind: layers", "kind: layer") ==
        "bay.yaml:7:9: seabed.kind: is \"layer\", not one of layers, raster, tiles");
  CHECK(problems_of(kBay, "boulders: {per_km2: 900", "boulders: {per_kn2: 900") ==
        "bay.yaml:8:62: seabed.layers.rocks.boulders.per_km2: is missing; allowed: a number in [0, 1e+08]\n"
        "bay.yaml:8:63: seabed.layers.rocks.boulders.per_kn2: is not a known key; did you mean per_km2?");
  CHECK(problems_of(kBay, "speed_kn: 4", "speed_kn: 40") ==
        "bay.yaml:17:10: mission: speed_mps is above what auv can do (fastest_mps)");
  CHECK(problems_of(kBay, "lawnmower: {centre_m: [0, 0], length_m: 200, spacing_m: 50, count: 3}",
                    "runlines: [{from_m: [0, 0], to_m: [0, 0]}]") ==
        "bay.yaml:17:58: mission.runlines[0].to_m: is less than 1 m from from_m");
  CHECK(problems_of(kBay, "latitude_deg: 42.5, longitude_deg: -70.5", "origin: raster") ==
        "bay.yaml:2:7: site: origin: raster needs seabed.kind: raster or tiles");
  CHECK(problems_of(kBay, "kind: layers\n", "kind: raster\n  raster: {path: no.tif, values: elevation}\n") ==
        "bay.yaml:8:18: seabed.raster.path: \"no.tif\": no such file or folder (searched beside this file and in the "
        "data "
        "folders)\n"
        "bay.yaml:9:11: seabed.layers: is not used by this kind of seabed");
}

TEST_CASE("UTC times become nanoseconds") {
  CHECK(parse_utc_ns("1970-01-01T00:00:00Z") == 0);
  CHECK(parse_utc_ns("2000-02-29T23:59:59.5Z") == 951868799500000000);
  CHECK(parse_utc_ns("2100-03-01T00:00:00Z") == 4107542400000000000);  // 2100 has no leap day
  CHECK_FALSE(parse_utc_ns("2100-02-29T00:00:00Z"));
  CHECK_FALSE(parse_utc_ns("2025-06-01 00:00:00"));
  CHECK_FALSE(parse_utc_ns("2025-06-01T24:00:00Z"));
  CHECK_FALSE(parse_utc_ns("2025-06-01T00:00:nanZ"));
}

}  // namespace ensonify

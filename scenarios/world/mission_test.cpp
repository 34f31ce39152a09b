// Missions as a scenario or a file of their own states them.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "components/config/config_reader.h"
#include "scenarios/world/world.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

World scenario_with(const std::string& mission, const std::string& vehicle = "turning_radius_m: 10") {
  auto from = ConfigReader::from_text(
      "ensonify: scenario/1\nsite: {latitude_deg: 53.2, longitude_deg: -9.6}\n"
      "seabed: {kind: layers, layers: {ground: {plane: {depth_m: 20}}}}\nvehicles: {auv: {" +
          vehicle + "}}\nmission:\n" + mission,
      "bay.yaml");
  World world = read_world(from, "bay.yaml");
  from.finish();
  return world;
}

std::string problems_of(const std::string& mission, const std::string& vehicle = "turning_radius_m: 10") {
  try {
    scenario_with(mission, vehicle);
    return "";
  } catch (const ConfigError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("a mission's steps are read in order, its straight legs with their depths") {
  const Mission mission = scenario_with(R"(  depth_m: 4
  run_out_m: 15
  repeat: 2
  steps:
    - {line: [[0, 0], [0, 100], [50, 150]], name: bank 1}
    - {speed_mps: 1.5, altitude_m: 6}
    - {pass: [60, 160], heading_deg: 90}
    - {keep: [80, 160], for_s: 30, within_m: 2}
    - {wait_s: 5}
    - {orbit: [80, 200], radius_m: 30, turns: 2, centre_to: port}
    - {set_sonar: bow, range_m: 40, swath_deg: 90}
    - mark: wreck
    - {depth_m: 3}
    - line: [[0, 0], [100, 0]]
)",
                                        "mountings: {bow: {actual: {}}}")
                              .mission;
  REQUIRE(mission.steps.size() == 10);
  CHECK(std::get<FollowLine>(mission.steps[0]).points_enu_m.size() == 3);
  CHECK(std::get<FollowLine>(mission.steps[0]).name == "bank 1");
  CHECK(std::get<GoAt>(mission.steps[1]).altitude_m == 6.0);
  CHECK(*std::get<PassPlace>(mission.steps[2]).heading_rad == Approx(1.5707963));
  CHECK(std::get<KeepPlace>(mission.steps[3]).within_m == 2.0);
  CHECK_FALSE(std::get<KeepPlace>(mission.steps[4]).place_enu_m);
  CHECK_FALSE(std::get<FollowOrbit>(mission.steps[5]).clockwise);
  CHECK(std::get<SetSonar>(mission.steps[6]).settings.swath_rad == Approx(1.5707963));
  CHECK(std::get<SetMark>(mission.steps[7]).text == "wreck");
  CHECK(mission.sonars() == std::vector<std::string>{"bow"});
  CHECK(mission.runlines.size() == 3);
  CHECK(mission.runline_depths_m() == std::vector<std::optional<double>>{4.0, 4.0, 3.0});
  CHECK(mission.run_out_m == 15.0);
  CHECK(mission.repeat == 2);
}

TEST_CASE("a mission stands in a file of its own, and what the scenario says as well counts") {
  const auto file = std::filesystem::temp_directory_path() / "ensonify_mission_test.yaml";
  std::ofstream(file) << "ensonify: mission/1\nspeed_mps: 3\nrun_in_m: 25\npositions: geodetic\n"
                         "steps:\n  - line: [[53.2, -9.6], [53.201, -9.6]]\n";
  const Mission mission = scenario_with("  file: " + file.string() + "\n  speed_mps: 1.5\n").mission;
  CHECK(mission.speed_mps == 1.5);
  CHECK(mission.run_in_m == 25.0);
  REQUIRE(mission.runlines.size() == 1);
  CHECK(mission.runlines[0].start_enu_m.norm() < 1e-6);
  CHECK_THAT(mission.runlines[0].end_enu_m.y(), WithinAbs(111.3, 0.1));  // 0.001 degrees of latitude at 53 degrees

  std::ofstream(file) << "ensonify: mission/1\nspeed_mps: .nan\nsteps:\n  - line: [[0, 0]]\n";
  const std::string problems = problems_of("  file: " + file.string() + "\n");
  CHECK(problems.find(file.string() + ":2:12: speed_mps: ") == 0);
  std::ofstream(file) << "ensonify: mission/1\nsteps:\n  - line: [[0, 0]]\n";
  CHECK(problems_of("  file: " + file.string() + "\n") ==
        file.string() + ":3:11: steps[0].line: has fewer than 2 places");
}

TEST_CASE("wrong positions are reported with their distance, and swapped ones recognised") {
  CHECK(problems_of("  positions: geodetic\n  steps:\n    - line: [[53.2, -9.6], [-9.6, 53.21]]\n") ==
        "bay.yaml:8:13: mission.steps[0].line: [-9.6, 53.21] is 9136 km from the site's origin; allowed: 100 km; are "
        "latitude "
        "and longitude swapped?");
  CHECK(problems_of("  positions: geodetic\n  steps:\n    - line: [[53.2, -9.6], [53.2, 9.6]]\n")
            .find("is 1275 km from the site's origin; allowed: 100 km") != std::string::npos);
  CHECK(problems_of("  steps:\n    - line: [[465000, 5895000], [465100, 5895000]]\n")
            .find("465000 is outside [-100000, 100000]") != std::string::npos);
  CHECK(problems_of("  steps:\n    - line: [[0, .nan], [10, 0]]\n").find("line") != std::string::npos);
  CHECK(problems_of("  steps:\n    - {line: [[0, 0], [10, 0]], name: " + std::string(201, 'x') + "}\n")
            .find("name: has 201 bytes; allowed: 200") != std::string::npos);
}

TEST_CASE("what cannot be run is reported before time starts") {
  CHECK(problems_of("  steps:\n    - line: [[0, 0], [0, 0]]\n") ==
        "bay.yaml:7:13: mission.steps[0].line: place 2 is less than 1 m from the one before");
  CHECK(problems_of("  steps:\n    - {orbit: [0, 50], radius_m: 5}\n    - line: [[0, 0], [0, 90]]\n")
            .find("step 1: radius_m 5 is less than auv can turn at 2 m/s; allowed: 10 m or more") != std::string::npos);
  CHECK(problems_of("  steps:\n    - {speed_mps: 12}\n    - line: [[0, 0], [0, 90]]\n")
            .find("step 1: speed_mps is above what auv can do (fastest_mps)") != std::string::npos);
  CHECK(problems_of("  speed_mps: 0.5\n  steps:\n    - {speed_mps: 8}\n    - line: [[0, 0], [0, 90]]\n",
                    "fastest_mps: 9, turn_rate_dps: 0.2")
            .find("mission: step 1: at speed_mps 8 turn_rate_dps makes auv turn on a radius of 2292 m; allowed: 1000 m "
                  "or less") != std::string::npos);
  // The second round's orbit is run at the speed that the first has ended with.
  const std::string orbits = "  steps:\n    - {orbit: [0, 50], radius_m: 25}\n    - {speed_mps: 3}\n";
  CHECK(problems_of(orbits, "turn_rate_dps: 6") == "");
  CHECK(problems_of("  repeat: 2\n" + orbits, "turn_rate_dps: 6").find("step 1: radius_m 25 is less than") !=
        std::string::npos);
  CHECK(problems_of("  abort: {too_low_s: 3}\n  steps:\n    - line: [[0, 0], [0, 90]]\n")
            .find("mission.abort: too_low_s needs an obstacle floor; allowed: with a least_altitude_m above 0") !=
        std::string::npos);
  CHECK(problems_of("  altitude_m: 5\n  steps:\n    - line: [[0, 0], [0, 90]]\n", "floats: {}")
            .find("need a vehicle that dives; auv floats") != std::string::npos);
  CHECK(problems_of("  depth_m: 3\n  steps:\n    - line: [[0, 0], [0, 90]]\n", "floats: {}")
            .find("depth_m needs a vehicle that dives; auv floats") != std::string::npos);
  CHECK(
      problems_of("  steps:\n    - line: [[0, 0], [0, 90]]\n    - {set_sonar: bow, range_m: 20}\n",
                  "mountings: {stern: {actual: {}}}")
          .find("bay.yaml:8:19: mission.steps[1].set_sonar: no vehicle carries a head named \"bow\"; allowed: stern") !=
      std::string::npos);
  CHECK(problems_of("  steps:\n    - {set_sonar: stren, range_m: 20}\n", "mountings: {stern: {actual: {}}}") ==
        "bay.yaml:7:19: mission.steps[0].set_sonar: no vehicle carries a head named \"stren\"; did you mean stern?");
  CHECK(problems_of("  steps:\n    - line: [[0, 0], [0, 90]]\n", "start: {position_m: [0, 0, 2]}")
            .find("vehicles.auv.start.position_m: up 2 is above the water; allowed: 0 or less") != std::string::npos);
  CHECK(problems_of("  steps:\n    - line: [[0, 0], [0, 90]]\n",
                    "fastest_mps: 3, start: {position_m: [0, 0, 0], speed_mps: 4}")
            .find("vehicles.auv.start: speed_mps 4 is above fastest_mps 3") != std::string::npos);
  CHECK(problems_of("  altitude_m: 2\n  least_altitude_m: 5\n  steps:\n    - line: [[0, 0], [0, 90]]\n")
            .find("mission: altitude_m 2 is below least_altitude_m 5; allowed: that or more") != std::string::npos);
  CHECK(problems_of("  least_altitude_m: 5\n  steps:\n    - line: [[0, 0], [0, 90]]\n    - {altitude_m: 4}\n")
            .find("mission: step 2: altitude_m 4 is below least_altitude_m 5") != std::string::npos);
  CHECK(problems_of("  depth_m: -3\n  steps:\n    - line: [[0, 0], [0, 90]]\n")
            .find("mission.depth_m: -3 is outside [0, 11000]") != std::string::npos);
  CHECK(problems_of("  steps:\n    - {line: [[0, 0], [0, 90]], wait_s: 3, mark: x}\n")
            .find("steps[0].wait_s: stands beside line; give one or the other") != std::string::npos);
  CHECK(problems_of("  steps:\n    - {line: [[0, 0], [0, 90]], wait_s: 3, mark: x}\n")
            .find("steps[0].mark: stands beside line; give one or the other") != std::string::npos);
  CHECK(problems_of("  steps:\n    - {hover: 3}\n").find("is no step; allowed: line, pass, keep") != std::string::npos);
  CHECK(problems_of("  steps:\n    - mark: x\n  lawnmower: {length_m: 9, spacing_m: 9, count: 1}\n")
            .find("has several plans; give one of runlines, lawnmower, auto, adaptive, follow, steps") !=
        std::string::npos);
  CHECK(problems_of("  speed_mps: 2\n").find("has no plan; give one of") != std::string::npos);
}

namespace {

using Heads = std::map<std::string, msg::HeadDeclaration>;

/// A head with these limits, as the others see it.
Heads head_of(const SettingLimits& limits, const std::string& name = "bow") {
  msg::HeadDeclaration head;
  head.channels = {{"", {}, limits.declared()}};
  return {{name, head}};
}

/// What a head refuses of a mission of one step.
std::string refused(const std::string& settings, const Heads& heads) {
  const Mission mission = scenario_with("  steps:\n    - {set_sonar: bow, " + settings + "}\n    - mark: end\n",
                                        "mountings: {bow: {actual: {}}}")
                              .mission;
  std::string text;
  for (const ConfigProblem& problem : setting_problems(mission, heads)) text += problem.text() + "\n";
  return text;
}

}  // namespace

TEST_CASE("a mission's setting beyond the limits of its head is refused, with its place") {
  SettingLimits limits;
  limits["source_level_db"] = {{175.0, 250.0}};
  limits["swath_rad"] = {{0.5, 2.6179938}};
  limits["range_m"] = {{1.0, 75.0}, true};
  limits["pulse_length_s"] = {{1e-4, 1e-3}};
  limits["mode"].words = {"bathymetry", "water_column"};
  const Heads heads = head_of(limits);
  CHECK(refused("source_level_db: 245, swath_deg: 150, range_m: 0, mode: water_column", heads) == "");
  CHECK(refused("source_level_db: 260", heads) ==
        "bay.yaml:7:41: mission.steps[0].source_level_db: 260 is outside [175, 250], the limits of bow\n");
  CHECK(refused("swath_deg: 160", heads) ==
        "bay.yaml:7:35: mission.steps[0].swath_deg: 160 is outside [28.6479, 150], the limits of bow\n");
  CHECK(refused("pulse_length_s: 0", heads) ==
        "bay.yaml:7:40: mission.steps[0].pulse_length_s: 0 leaves it to bow, which does not choose; allowed: [0.0001, "
        "0.001]\n");
  CHECK(refused("mode: bathymetri", heads) ==
        "bay.yaml:7:30: mission.steps[0].mode: bathymetri is no word of bow; allowed: bathymetry, water_column\n");
  CHECK(refused("gain_offset_db: 3", heads) ==
        "bay.yaml:7:40: mission.steps[0].gain_offset_db: bow has no such setting\n");
  CHECK(refused("source_level_db: 260", head_of(limits, "stern")) == "");  // bow has not declared its limits

  SettingLimits narrow = limits, wide = limits;
  narrow["source_level_db"] = {{175.0, 215.0}};
  CHECK(refused("source_level_db: 245", head_of(narrow)) != "");
  narrow.widen(wide);
  CHECK(refused("source_level_db: 245", head_of(narrow)) == "");
}

TEST_CASE("every field of the message is a setting of missions, with limits, and no list names it again") {
  const msg::SonarSettings message;
  for_settings(message, [](const char* name, const char* unit, const char*, const auto& member) {
    INFO(name);
    constexpr bool is_text = std::is_same_v<std::remove_cvref_t<decltype(member)>, std::string>;
    const SettingInFile file = setting_in_file(name, unit);
    SettingLimits limits;
    if (is_text) limits[name].words = {"7"};
    else limits[name] = {{6.0 * file.si, 8.0 * file.si}};
    CHECK(refused(file.key + ": 7", head_of(limits)) == "");
    CHECK(refused(file.key + ": 9", head_of(limits)) != "");
    CHECK(refused(file.key + ": 7", head_of({})) != "");  // it has no such setting
  });
}

TEST_CASE("an adaptive mission begins with its first line, so far from the port edge") {
  const Mission mission =
      scenario_with("  adaptive: {centre_m: [100, 0], heading_deg: 0, length_m: 60, width_m: 200, first_line_m: 20}\n")
          .mission;
  REQUIRE(mission.runlines.size() == 1);
  CHECK((mission.runlines[0].start_enu_m - runlines::Vec2(20, -30)).norm() < 1e-9);
  CHECK((mission.runlines[0].end_enu_m - runlines::Vec2(20, 30)).norm() < 1e-9);
  CHECK(problems_of("  adaptive: {centre_m: [0, 0], length_m: 60, width_m: 200, first_line_m: 300}\n")
            .find("first_line_m: lies beyond width_m") != std::string::npos);
}

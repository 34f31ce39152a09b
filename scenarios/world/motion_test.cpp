// Vehicles' motion, water level and current as a scenario states them.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "components/config/config_reader.h"
#include "scenarios/world/world.h"

using namespace ensonify;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

std::string scenario_text(const std::string& vehicle, const std::string& sections = "") {
  return "ensonify: scenario/1\nsite: {latitude_deg: 42, longitude_deg: -70}\n"
         "time: {start_utc: \"2025-06-01T12:00:00Z\"}\nseabed: {kind: layers, layers: {ground: {plane: {depth_m: "
         "20}}}}\n" +
         sections + "\nvehicles:\n  boat: {" + vehicle +
         "}\nmission: {speed_mps: 2, run_in_m: 10, runlines: [{from_m: [0, 0], to_m: [0, 990]}]}\n";
}

World scenario_of(const std::string& text) {
  auto from = ConfigReader::from_text(text, "bay.yaml");
  World world = read_world(from, "bay.yaml");
  from.finish();
  return world;
}

std::string problems_of(const std::string& text) {
  try {
    scenario_of(text);
    return "";
  } catch (const ConfigError& error) {
    return error.what();
  }
}

std::string written(const std::string& name, const std::string& text) {
  const std::string path = std::string(std::getenv("ENSONIFY_BUILD")) + "/" + name;
  std::ofstream(path) << text;
  return path;
}

}  // namespace

TEST_CASE("a disturbance is a preset and what differs from it") {
  const auto p =
      scenario_of(scenario_text("disturbance: {preset: research_ship, roll: {oscillation_deg: 3, hurst: 0.3}}"))
          .vehicles[0]
          .disturbance;
  CHECK(p.roll.oscillation_sd == Approx(3 * kDegree));
  CHECK(p.roll.period_s == 12.8);
  CHECK(p.roll.hurst == 0.3);
  CHECK(p.heave.oscillation_sd == 1.12);
  CHECK(problems_of(scenario_text("disturbance: {preset: ferry}")).find("research_ship, survey_launch") !=
        std::string::npos);
  CHECK(problems_of(scenario_text("disturbance: {heave: {oscillation_m: 1, period_s: 0.3}}")) ==
        "bay.yaml:7:23: vehicles.boat.disturbance: disturbance of heave: 1 / period_s is above highest_hz");
}

TEST_CASE("a hydrodynamic vehicle names its file, and only such a one") {
  CHECK(scenario_of(scenario_text("kind: hydrodynamic, dynamics: components/vehicle/hydrodynamic/remus_100.yaml"))
            .vehicles[0]
            .dynamics_file.find("remus_100.yaml") != std::string::npos);
  CHECK(problems_of(scenario_text("kind: hydrodynamic")).find("vehicles.boat.dynamics: is missing") !=
        std::string::npos);
  CHECK(problems_of(scenario_text("dynamics: x.yaml")).find("dynamics: needs kind: hydrodynamic") != std::string::npos);
}

TEST_CASE("a harmonic tide is high when its phase says, from its reference time") {
  // M2 high at 06:00; the scenario starts at 12:00, six hours later: 28.984 * 6 = 173.9 degrees on.
  const World s = scenario_of(scenario_text(
      "floats: {settlement: [{speed_mps: 0, lower_m: 0}, {speed_mps: 4, lower_m: 0.1}], deeper_m: 0.02}",
      "vertical:\n  tide: {mean_m: 2, constituents: [{constituent: M2, amplitude_m: 1.5, "
      "reference_utc: \"2025-06-01T06:00:00Z\"}]}\n  geoid_above_ellipsoid_m: -28.5\n  datum_above_geoid_m: -1.6"));
  CHECK(s.vertical.tide.at(-6 * 3600.0).height_m == Approx(3.5));
  CHECK(s.vertical.tide.at(0.0).height_m == Approx(2 + 1.5 * std::cos(6 * 28.9841042 * kDegree)));
  CHECK(s.vertical.datums.geoid_above_ellipsoid.at({0, 0}) == -28.5);
  CHECK(vertical::geoid_height_m(s.vertical.datums, {0, 0, 3}) == Approx(3 - 1.6));
  REQUIRE(s.vehicles[0].floats.has_value());
  CHECK(vertical::sinkage_m(*s.vehicles[0].floats, 2.0, 0.0) == Approx(0.07));
  CHECK(problems_of(scenario_text("", "vertical: {tide: {constituents: [{constituent: M7, amplitude_m: 1}]}}"))
            .find("\"M7\" is no tidal constituent; allowed: 2N2, ") != std::string::npos);
  CHECK(problems_of(scenario_text("", "vertical: {tide: {constant_m: 1, gauge: x.csv}}"))
            .find("says several things; give one of constant_m, constituents, gauge") != std::string::npos);
}

TEST_CASE("a gauge's file is read in UTC, and must cover the survey") {
  const std::string good =
      written("tide_good.csv", "time,height_m\n2025-06-01T11:50:00Z,1.0\n2025-06-01T12:30:00Z,1.4\n");
  const auto tide = scenario_of(scenario_text("", "vertical: {tide: {gauge: " + good + "}}")).vertical.tide;
  CHECK(tide.at(0.0).height_m == Approx(1.1));
  CHECK(tide.at(1200.0).height_m == Approx(1.3));

  const std::string brief = written("tide_brief.csv", "2025-06-01T11:50:00Z,1.0\n2025-06-01T12:05:00Z,1.4\n");
  CHECK(problems_of(scenario_text("", "vertical: {tide: {gauge: " + brief + "}}")) ==
        "bay.yaml:5:11: vertical: the tide's last reading is 300 s after the start, and the mission takes 500 s "
        "without its turns; allowed: a file that covers the survey");
  // Two rounds: a line of 80 m with 10 m before and 10 m behind it at 2 m/s, then at 1 m/s; twice 100 s of waiting and
  // half a circle of 20 m at 1 m/s.
  std::string rounds = scenario_text("", "vertical: {tide: {gauge: " + brief + "}}");
  rounds.replace(rounds.find("mission:"), std::string::npos,
                 "mission: {speed_mps: 2, run_in_m: 10, run_out_m: 10, repeat: 2, steps: [{line: [[0, 0], [0, 80]]}, "
                 "{speed_mps: 1}, {wait_s: 100}, {orbit: [0, 80], radius_m: 20, turns: 0.5}]}\n");
  CHECK(problems_of(rounds).find("and the mission takes 476 s without its turns") != std::string::npos);
  rounds.replace(rounds.find("repeat: 2"), 9, "repeat: 2, abort: {after_s: 290}");
  CHECK(problems_of(rounds) == "");
  const std::string late = written("tide_late.csv", "2025-06-01T12:05:00Z,1.0\n2025-06-01T13:05:00Z,1.4\n");
  CHECK(problems_of(scenario_text("", "vertical: {tide: {gauge: " + late + "}}")) ==
        "bay.yaml:5:11: vertical: the tide's first reading is 300 s after the start; allowed: one at the start or "
        "before");
  const std::string back = written("tide_back.csv", "2025-06-01T12:05:00Z,1.0\n2025-06-01T12:04:00Z,1.4\n");
  CHECK(problems_of(scenario_text("", "vertical: {tide: {gauge: " + back + "}}"))
            .find("tide_back.csv:2:1: is not later than the reading before") != std::string::npos);
  const std::string none = written("tide_none.csv", "2025-06-01T11:50:00Z,1.0\n2025-06-01T12:05:00Z,nan\n");
  CHECK(problems_of(scenario_text("", "vertical: {tide: {gauge: " + none + "}}"))
            .find("tide_none.csv:2:1: has no height in [-20, 20] m") != std::string::npos);
  const std::string wrong = written("tide_wrong.csv", "2025-13-01T11:50:00Z,1.0\n2025-06-01T13:05:00Z,1.1\n");
  CHECK(problems_of(scenario_text("", "vertical: {tide: {gauge: " + wrong + "}}"))
            .find("tide_wrong.csv:1:1: does not begin with a UTC time") != std::string::npos);
}

TEST_CASE("a gauge's readings may lie apart before the run, and during it no more than 6 h") {
  const auto problems = [](const std::string& name, const std::string& readings) {
    return problems_of(scenario_text("", "vertical: {tide: {gauge: " + written(name, readings) + "}}"));
  };
  CHECK(problems("tide_apart.csv", "2025-06-01T11:50:00Z,1.0\n2025-06-01T18:00:00Z,1.4\n")
            .find("tide_apart.csv:2:1: is 6.2 h after the reading before; allowed from the start of the run on: 6 h") !=
        std::string::npos);
  CHECK(problems("tide_early.csv", "2025-05-01T11:50:00Z,1.0\n2025-06-01T11:50:00Z,1.0\n2025-06-01T17:50:00Z,1.4\n") ==
        "");
}

TEST_CASE("a grid of separations is an Esri file from north to south") {
  const std::string path =
      written("geoid.asc", "ncols 2\nnrows 2\nxllcorner -50\nyllcorner -50\ncellsize 50\n47 48\n45 46\n");
  const auto grid = read_separation(path);
  CHECK(grid.at({-25, -25}) == 45.0);
  CHECK(grid.at({25, 25}) == 48.0);
  CHECK(grid.at({0, 0}) == Approx(46.5));
  CHECK_THROWS_WITH(
      read_separation(written("hole.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 5\n1 2\n3\n")),
      Catch::Contains("hole.asc:7:1: lacks a value in [-200, 200] m"));
}

TEST_CASE("a grid of separations as GDAL writes it, with a value that stands for none") {
  const std::string head = "ncols 2\nnrows 2\nxllcorner -50\nyllcorner -50\ncellsize 50\nNODATA_value -88.88\n";
  CHECK(read_separation(written("gdal.asc", head + " 47 48\n 45 46\n")).at({-25, 25}) == 47.0);
  CHECK_THROWS_WITH(read_separation(written("none.asc", head + " 47 48\n 45 -88.88\n")),
                    Catch::Contains("none.asc:8:1: lacks a value in [-200, 200] m"));
  CHECK_THROWS_WITH(
      read_separation(written("word.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 5\nnan 48\n45 46\n")),
      Catch::Contains("word.asc:6:1: is neither NODATA_value with a number nor a row of values"));
}

TEST_CASE("grids of datums must cover the site") {
  // A generated seabed of 600 x 600 m about the origin, a line to 990 m north; a grid of 1400 x 1400 m.
  const auto problems = [](const std::string& key, double west_m, double south_m) {
    const std::string path =
        written("site.asc", "ncols 2\nnrows 2\nxllcorner " + std::to_string(west_m) + "\nyllcorner " +
                                std::to_string(south_m) + "\ncellsize 700\n1 1\n1 1\n");
    return problems_of(scenario_text("", "vertical: {" + key + ": " + path + "}"));
  };
  CHECK(problems("geoid_above_ellipsoid_grid", -301, -301) == "");
  CHECK(problems("geoid_above_ellipsoid_grid", -299, -301) ==
        "bay.yaml:5:40: vertical.geoid_above_ellipsoid_grid: does not cover (-300.0, -300.0) m; allowed: a grid over "
        "the whole seabed and all lines, east and north in metres of the world");
  CHECK(problems("datum_above_geoid_grid", -1101, -301).find("_geoid_grid: does not cover (300.0, -300.0) m") !=
        std::string::npos);
  CHECK(problems("datum_above_geoid_grid", -301, -411).find("_geoid_grid: does not cover (0.0, 990.0) m") !=
        std::string::npos);
}

TEST_CASE("a current has a profile and streams, towards their headings") {
  const auto current = scenario_of(scenario_text("",
                                                 "current: {profile: [{depth_m: 0, speed_mps: 0.4, heading_deg: 90}, "
                                                 "{depth_m: 10, speed_mps: 0.2, heading_deg: 90}], "
                                                 "streams: [{constituent: M2, speed_mps: 0.5, heading_deg: 0}]}"))
                           .current;
  CHECK((current.velocity_enu_mps(5.0, 0.0) - frames::Vec2(0.3, 0.5)).norm() < 1e-9);
  CHECK(problems_of(scenario_text("",
                                  "current: {profile: [{depth_m: 5, speed_mps: 1, heading_deg: 0}, "
                                  "{depth_m: 5, speed_mps: 1, heading_deg: 0}]}"))
            .find("is not below the depth before it; depths rise") != std::string::npos);
}

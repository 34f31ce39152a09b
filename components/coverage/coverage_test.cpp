#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "components/config/config_error.h"
#include "components/coverage/node.h"
#include "components/runtime/testing/node_under_test.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

/// A rectangle of 1000 x 60 m on a plane from 10 m in the west to 40 m in the east, surveyed northwards and back.
World slope() {
  World world;
  AdaptivePlan plan;
  plan.centre_enu_m = {500, 30};
  plan.length_m = 60;
  plan.width_m = 1000;
  plan.first_line_m = 15;
  plan.soundings = 4;
  world.mission.adaptive = plan;
  world.vehicles = {{"boat"}};
  return world;
}

CoverageConfig config_of(const World& world) {
  ConfigReader from = ConfigReader::from_text("{}", "coverage.yaml");
  return CoverageConfig::read(from, world, "coverage");
}

double depth_m(double east_m) { return 10.0 + 0.03 * east_m; }

/// Soundings of a fan of 121 beams over 60 degrees either side.
msg::Soundings ping_at(double east_m, double north_m, SimTime t) {
  msg::Soundings soundings;
  soundings.stamp_ns = t.count();
  soundings.valid = msg::Array<std::uint8_t>({121});
  soundings.tvu_m = msg::Array<float>({121});
  soundings.thu_m = msg::Array<float>({121});
  soundings.position_enu_m = msg::Array<double>({121, 3});
  for (std::size_t i = 0; i < 121; ++i) {
    const double tangent = std::tan((static_cast<double>(i) - 60.0) * 3.14159265358979 / 180.0);
    const double x = depth_m(east_m) * tangent / (1.0 - 0.03 * tangent);
    soundings.valid[i] = 1;
    soundings.tvu_m[i] = i < 110 ? 0.2F : 0.5F;  // 9 % of the beams beyond Special Order, as far down as 40 m
    soundings.thu_m[i] = 1.0F;
    soundings.position_enu_m(i, 0) = east_m + x;
    soundings.position_enu_m(i, 1) = north_m;
    soundings.position_enu_m(i, 2) = -depth_m(east_m + x);
  }
  return soundings;
}

}  // namespace

TEST_CASE("a mission that is not adaptive has nothing to cover") {
  ConfigReader from = ConfigReader::from_text("{}", "coverage.yaml");
  CoverageConfig::read(from, World{}, "coverage");
  CHECK_THROWS_WITH(from.finish(), Catch::Contains("needs a mission that is adaptive"));
}

TEST_CASE("lines are laid where coverage ends until all is covered; savings are reported") {
  const auto folder = std::filesystem::temp_directory_path() / "ensonify_coverage_test";
  std::filesystem::create_directories(folder);
  NodeUnderTest<CoverageNode> coverage(config_of(slope()), "test", folder);
  double east_m = 15.0;
  SimTime t{0};
  std::int64_t line = 0;
  for (; line < 60; ++line) {
    for (double north_m = 0.5; north_m < 60.0; north_m += 1.0) {
      coverage.give("soundings", ping_at(east_m, north_m, t));
      t += 100_ms;
    }
    msg::MissionState mission;
    mission.stamp_ns = t.count();
    mission.state = "await_line";
    mission.line = line;
    coverage.give("mission", mission);
    t += 4_s;
    const auto next = coverage.step_until<msg::NextLine>("next_line", t);
    REQUIRE(next.size() == 1);
    CHECK(next[0].number == line + 1);
    if (next[0].done) break;
    CHECK(next[0].start_enu_m[0] > east_m);
    CHECK_THAT(next[0].start_enu_m[1], WithinAbs(line % 2 == 0 ? 60.0 : 0.0, 1e-9));  // there and back
    east_m = next[0].start_enu_m[0];
  }
  const auto coverages = coverage.step_until<msg::Coverage>("coverage", t + 1_s);
  REQUIRE_FALSE(coverages.empty());
  CHECK(coverages.back().covered == 1.0);
  CHECK(coverages.back().lines == line + 1);
  CHECK(coverages.back().overlapped > 1.0);
  CHECK(coverages.back().overlapped < 1.3);
  // d1 ln(d2 / d1) / (d2 - d1) = 0.462 of the lines that 10 m ask for, 1000 / (1.9 * 10 * 1.732) = 31.
  CHECK(static_cast<double>(line + 1) < 1.15 * 0.462 * 31);

  coverage.node().finish_run();
  std::ifstream file(folder / "coverage.json");
  const std::string report{std::istreambuf_iterator<char>(file), {}};
  CHECK(report.find("\"holes\": 0") != std::string::npos);
  CHECK(report.find("\"lines_for_holes\": 0") != std::string::npos);
  // Pings 1 m apart, beams up to 4 x 40 m x 1 degree / cos^2 = 2.8 m: 4 soundings take two of each, but for the rows
  // at the rectangle's ends no more than 2 x 2.8 m and the two cells that are not given.
  const auto cube = nlohmann::json::parse(report)["cube_m"];
  CHECK(cube["everywhere"].get<double>() > 2.0);
  CHECK(cube["everywhere"].get<double>() < 6.1);
  CHECK(cube["in_95_percent"] <= cube["everywhere"]);
  CHECK(cube["share_found_of_1_m"] < cube["share_found_of_2_m"]);
  const auto uncertainty = nlohmann::json::parse(report)["uncertainty"];
  CHECK(uncertainty["soundings"] == (line + 1) * 60 * 121);
  CHECK(uncertainty["tvu_95_m"].get<double>() == Approx(0.5));
  CHECK(uncertainty["thu_95_m"] == 1.0);
  CHECK(uncertainty["share_in_special_order"].get<double>() == Approx(110.0 / 121.0));
  CHECK(uncertainty["share_in_order_1a"] == 1.0);
  const auto order_1a = nlohmann::json::parse(report)["order_1a"];
  CHECK(order_1a["uncertainty"] == true);
  CHECK(order_1a["coverage"] == true);
  CHECK(order_1a["feature_search"] == false);  // cubes of 2 m are not found everywhere
  CHECK(order_1a["holds"] == false);
}

TEST_CASE("an order holds when soundings, coverage and feature search all do") {
  // One sounding is enough; pings 0.5 m apart, beams up to 12 m x 1 degree / cos^2 = 0.84 m: one on every cube of 2 m
  // less the two cells that are not given.
  const auto folder = std::filesystem::temp_directory_path() / "ensonify_order_test";
  std::filesystem::create_directories(folder);
  World world = slope();
  world.mission.adaptive->centre_enu_m = {20, 30};
  world.mission.adaptive->width_m = 20;
  world.mission.adaptive->soundings = 1;
  NodeUnderTest<CoverageNode> coverage(config_of(world), "test", folder);
  SimTime t{0};
  const auto report = [&](double from_m, double to_m) {
    for (double north_m = from_m; north_m < to_m; north_m += 0.5, t += 100_ms) {
      coverage.give("soundings", ping_at(20.0, north_m, t));
    }
    coverage.run_until(t);
    coverage.node().finish_run();
    std::ifstream file(folder / "coverage.json");
    return nlohmann::json::parse(file);
  };
  const auto half = report(0.25, 30.0);
  CHECK(half["order_1a"]["uncertainty"] == true);
  CHECK(half["order_1a"]["coverage"] == false);
  CHECK(half["order_1a"]["holds"] == false);
  const auto whole = report(30.25, 60.0);
  CHECK(whole["order_1a"]["coverage"] == true);
  CHECK(whole["order_1a"]["feature_search"] == true);
  CHECK(whole["order_1a"]["cube_m"] == 2.0);
  CHECK(whole["order_1a"]["holds"] == true);
  CHECK(whole["special_order"]["uncertainty"] == false);  // 9 % of the beams are too uncertain
  CHECK(whole["special_order"]["holds"] == false);
}

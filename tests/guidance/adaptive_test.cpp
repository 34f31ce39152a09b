// The adaptive survey of scenarios/slope_overlap: autopilot and coverage in closed loop with a kinematic boat, over the
// scenario's own seabed. Soundings are geometry: 256 beams over 130 degrees that meet the seabed across the track.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "components/autopilot/node.h"
#include "components/coverage/node.h"
#include "components/runtime/config/config_reader.h"
#include "components/runtime/terrain/source_of.h"
#include "components/runtime/testing.h"
#include "kernels/motion/kinematics.h"

using namespace ensonify;
using navigation::Vec2;

namespace {

constexpr double kStep_m = 1.0;  // between the places across the track at which the seabed is looked at
constexpr int kReach = 160;      // such steps to either side
constexpr std::size_t kBeams = 256;

msg::Soundings sound(const source::TerrainSource& terrain, const motion::State& boat, SimTime now) {
  const Vec2 place = boat.position_enu_m.head<2>();
  const Vec2 starboard(std::cos(boat.heading_rad), -std::sin(boat.heading_rad));
  std::array<double, 2 * kReach + 1> depth_m;
  for (int i = -kReach; i <= kReach; ++i) {
    depth_m[static_cast<std::size_t>(i + kReach)] = -terrain.height_m(place + i * kStep_m * starboard);
  }
  msg::Soundings soundings;
  soundings.stamp_ns = now.count();
  soundings.valid = msg::Array<std::uint8_t>({kBeams});
  soundings.position_enu_m = msg::Array<double>({kBeams, 3});
  for (std::size_t beam = 0; beam < kBeams; ++beam) {
    const double angle_rad = (static_cast<double>(beam) + 0.5 - 0.5 * kBeams) / kBeams * 130.0 * 3.14159265 / 180.0;
    const double cotangent = 1.0 / std::tan(std::abs(angle_rad));
    const int side = angle_rad < 0.0 ? -1 : 1;
    for (int i = 0; i < kReach; ++i) {  // the first step in which the beam is at the seabed
      const double near_m = depth_m[static_cast<std::size_t>(kReach + side * i)];
      const double far_m = depth_m[static_cast<std::size_t>(kReach + side * (i + 1))];
      const double above_near_m = near_m - i * kStep_m * cotangent;
      const double above_far_m = far_m - (i + 1) * kStep_m * cotangent;
      if (std::isnan(near_m) || std::isnan(far_m)) break;
      if (above_far_m > 0.0) continue;
      const double part = above_near_m / (above_near_m - above_far_m);
      const double x_m = side * (i + part) * kStep_m;
      soundings.valid[beam] = 1;
      soundings.position_enu_m(beam, 0) = place.x() + x_m * starboard.x();
      soundings.position_enu_m(beam, 1) = place.y() + x_m * starboard.y();
      soundings.position_enu_m(beam, 2) = -(near_m + part * (far_m - near_m));
      break;
    }
  }
  return soundings;
}

/// The seabed of slope_overlap, and the adaptive survey of launch/adaptive.yaml over it.
struct Slope {
  Scenario scenario = read_scenario(
      std::string(std::getenv("ENSONIFY_SOURCE")) + "/scenarios/slope_overlap/scenario.yaml",
      {{"mission", parse_config_value("{speed_mps: 4, run_in_m: 30, adaptive: {centre_m: [0, 0], heading_deg: 180, "
                                      "length_m: 60, width_m: 2900, first_line_m: 12, overlap: 0.02, cell_m: 6}}",
                                      {"adaptive_test", 0, 0})}});
  std::unique_ptr<source::TerrainSource> terrain = source::source_of({scenario.site, scenario.seabed, "", 1, {}});
};

/// Flies a mission over the slope while coverage looks on, and, where the mission is adaptive, lays the lines. Returns
/// coverage's report.
nlohmann::json fly(const Slope& slope, const Scenario& flown) {
  auto empty = ConfigReader::from_text("{}", "test.yaml");
  const auto pilot_config = AutopilotConfig::read(empty, flown, "pilot");
  const auto coverage_config = CoverageConfig::read(empty, slope.scenario, "coverage");
  const auto folder = std::filesystem::temp_directory_path() / "ensonify_adaptive_test";
  std::filesystem::create_directories(folder);

  NodeUnderTest<AutopilotNode> pilot(pilot_config);
  NodeUnderTest<CoverageNode> coverage(coverage_config, "test", folder);
  motion::State boat = start_of(pilot_config.plan, flown.mission.runlines);
  motion::Command command{boat.heading_rad, boat.speed_mps, 0.0};
  for (SimTime now{0}; now < 7200_s && !pilot.finished(); now += 100_ms) {
    msg::Estimate estimate;
    estimate.stamp_ns = now.count();
    estimate.position_enu_m = {boat.position_enu_m.x(), boat.position_enu_m.y(), 0.0};
    estimate.enu_from_body = frames::wxyz_of(frames::enu_from_body({boat.heading_rad, 0.0, 0.0}));
    estimate.velocity_enu_mps = {boat.speed_mps * std::sin(boat.heading_rad),
                                 boat.speed_mps * std::cos(boat.heading_rad), 0.0};
    pilot.give("estimate", estimate);
    const auto next_lines = coverage.step_until<msg::NextLine>("next_line", now);
    if (flown.mission.adaptive) {
      for (const auto& line : next_lines) pilot.give_at("next_line", now, line);
    }
    const auto orders = pilot.step_until<msg::Guidance>("command", now);
    for (const auto& mission : pilot.step_until<msg::MissionState>("mission", now)) {
      coverage.give_at("mission", now, mission);
      const bool pings = now.count() % 500'000'000 == 0 && mission.state != "turn";  // 2 Hz
      if (pings) coverage.give_at("soundings", now, sound(*slope.terrain, boat, now));
    }
    boat = motion::advance(boat, command, 0.1, pilot_config.plan.limits);
    if (!orders.empty()) command = {orders[0].heading_grid_rad, orders[0].speed_mps, 0.0};
  }
  REQUIRE(pilot.finished());
  coverage.node().finish_run();
  std::ifstream stream(folder / "coverage.json");
  return nlohmann::json::parse(stream);
}

/// The same survey with so many lines at one distance, from the shallow side to the deep one.
Scenario with_fixed_lines(const Slope& slope, std::size_t count) {
  Scenario fixed = slope.scenario;
  const AdaptivePlan plan = *std::exchange(fixed.mission.adaptive, std::nullopt);
  fixed.mission.runlines.clear();
  for (std::size_t i = 0; i < count; ++i) {
    AdaptivePlan at = plan;
    at.first_line_m = plan.width_m * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    navigation::Runline line = first_line(at);
    if (i % 2 == 1) std::swap(line.start_enu_m, line.end_enu_m);
    fixed.mission.runlines.push_back(line);
  }
  fixed.mission.steps = steps_of(fixed.mission.runlines);
  return fixed;
}

}  // namespace

TEST_CASE(
    "slope_overlap takes at least 45 % less track than lines at a fixed distance, leaves no gap, and is near the "
    "bound") {
  const Slope slope;
  const auto report = fly(slope, slope.scenario);
  INFO(report.dump(2));
  CHECK(report["holes"] == 0);
  CHECK(report["covered"] == 1.0);
  CHECK(report["share_of_fixed"] <= 0.55);
  CHECK(report["share_of_fixed"] <= 1.15 * report["bound"].get<double>());

  // Lines at one distance are flown too: as many as adaptive ones over 0.55 leave gaps, so what covers as
  // much takes more.
  const auto lines = report["lines"].get<double>();
  const auto wide = fly(slope, with_fixed_lines(slope, static_cast<std::size_t>(lines / 0.55)));
  INFO(wide.dump(2));
  CHECK(wide["covered"] < 1.0);
}

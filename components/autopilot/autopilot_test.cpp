#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "components/autopilot/node.h"
#include "components/runtime/config/config_error.h"
#include "components/runtime/config/default_yaml.h"
#include "components/runtime/testing.h"
#include "kernels/motion/kinematics.h"

using namespace ensonify;

namespace {

AutopilotConfig three_lines(double spacing_m) {
  AutopilotConfig config;
  config.plan.scenario_file = "bay.yaml";
  config.plan.limits = {.acceleration_mps2 = 0.5, .deceleration_mps2 = 0.5, .turning_radius_m = 10};
  config.plan.mission.speed_mps = 2.0;
  config.plan.mission.run_in_m = 15.0;
  config.plan.mission.runlines = navigation::lawnmower({0, 0}, 0.3, 150, spacing_m, 3);
  return config;
}

/// The vehicle and navigation of a test: kinematics on one side, a perfect estimate on the other, 0.1 s of delay.
class Loop {
 public:
  Loop(const AutopilotConfig& config, const motion::State& start)
      : autopilot(config), limits_(config.plan.limits), state_(start) {
    command_ = {start.heading_rad, start.speed_mps, start.position_enu_m.z()};
  }

  /// Runs until the mission is done or `t`; `see(mission state, vehicle state)` at each command.
  template <class See>
  void run_until(SimTime t, See&& see) {
    motion::Command next = command_;
    for (SimTime now = now_; now <= t && !autopilot.finished(); now += 100_ms) {
      msg::Estimate estimate;
      estimate.stamp_ns = now.count();
      estimate.position_enu_m = {state_.position_enu_m.x(), state_.position_enu_m.y(), 0.0};
      estimate.enu_from_body = frames::wxyz_of(frames::enu_from_body(frames::Attitude{state_.heading_rad, 0, 0}));
      estimate.velocity_enu_mps = {state_.speed_mps * std::sin(state_.heading_rad),
                                   state_.speed_mps * std::cos(state_.heading_rad), 0.0};
      autopilot.give("estimate", estimate);
      const auto orders = autopilot.step_until<msg::Guidance>("command", now);
      for (const auto& mission : autopilot.step_until<msg::MissionState>("mission", now)) see(mission, state_);
      command_ = next;
      if (!orders.empty()) next = {orders[0].heading_grid_rad, orders[0].speed_mps, 0.0};
      state_ = motion::advance(state_, command_, 0.1, limits_);
      now_ = now + 100_ms;
    }
  }

  NodeUnderTest<AutopilotNode> autopilot;
  SimTime now() const { return now_; }

 private:
  motion::Limits limits_;
  motion::State state_;
  motion::Command command_;
  SimTime now_{0};
};

}  // namespace

TEST_CASE("autopilot/default.yaml lists every parameter with its default") {
  Scenario scenario;
  scenario.vehicles.resize(1);
  scenario.mission.runlines = {{{0, 0}, {0, 100}}};
  CHECK(default_yaml_fault<AutopilotConfig>("autopilot", scenario) == "");
}

TEST_CASE("lines are flown in order, whole, within a hand of their track, and then the run ends") {
  for (const double spacing_m : {8.0, 20.0, 24.0, 40.0}) {  // below, at and above two turning radii
    const AutopilotConfig config = three_lines(spacing_m);
    Loop loop(config, start_of(config.plan, config.plan.mission.runlines));
    std::vector<std::string> states;
    std::vector<double> shortest_to_go(3, 1e9), longest_to_go(3, 0);
    double worst_m = 0.0;
    loop.run_until(600_s, [&](const msg::MissionState& mission, const motion::State&) {
      const std::string state = mission.state + std::to_string(mission.line);
      if (states.empty() || states.back() != state) states.push_back(state);
      CHECK(mission.line_count == 3);
      if (mission.state != "on_line") return;
      const auto line = static_cast<std::size_t>(mission.line);
      shortest_to_go[line] = std::min(shortest_to_go[line], mission.distance_to_go_m);
      longest_to_go[line] = std::max(longest_to_go[line], mission.distance_to_go_m);
      worst_m = std::max(worst_m, std::abs(mission.cross_track_m));
    });
    INFO("spacing " << spacing_m << " m, ended at " << seconds(loop.now()) << " s");
    CHECK(states == std::vector<std::string>{"run_in0", "on_line0", "turn0", "run_in1", "on_line1", "turn1", "run_in2",
                                             "on_line2", "done2"});
    CHECK(worst_m < 0.25);
    for (std::size_t line = 0; line < 3; ++line) {
      CHECK(longest_to_go[line] > 149.5);
      CHECK(shortest_to_go[line] < 0.5);
    }
    CHECK(loop.autopilot.finished());
  }
}

TEST_CASE("a turn takes about as long as its shortest way") {
  const AutopilotConfig config = three_lines(24.0);  // two planned radii: half a circle
  Loop loop(config, start_of(config.plan, config.plan.mission.runlines));
  int in_turn = 0;
  loop.run_until(600_s,
                 [&](const msg::MissionState& mission, const motion::State&) { in_turn += mission.state == "turn"; });
  const double way_m = 2 * (3.14159 * 12 + config.plan.mission.run_in_m);  // two half circles, then back to the run-ins
  CHECK(0.1 * in_turn * 2.0 == Approx(way_m).margin(4.0));
}

TEST_CASE("a vehicle that starts elsewhere and at rest finds the first line") {
  const AutopilotConfig config = three_lines(30.0);
  Loop loop(config, {{120, -80, 0}, 2.0, 0.0});
  double worst_m = 0.0;
  std::set<std::int64_t> lines;
  loop.run_until(900_s, [&](const msg::MissionState& mission, const motion::State&) {
    if (mission.state != "on_line") return;
    lines.insert(mission.line);
    worst_m = std::max(worst_m, std::abs(mission.cross_track_m));
  });
  CHECK(lines == std::set<std::int64_t>{0, 1, 2});
  CHECK(worst_m < 0.25);
  CHECK(loop.autopilot.finished());
}

TEST_CASE("on a line the commanded speed is the mission's, in turns its fraction, and zero when done") {
  AutopilotConfig config = three_lines(30.0);
  config.turn_speed_fraction = 0.5;
  Loop loop(config, start_of(config.plan, config.plan.mission.runlines));
  double least_in_turn = 9, least_late_on_line = 9;
  loop.run_until(600_s, [&](const msg::MissionState& mission, const motion::State& vehicle) {
    if (mission.state == "turn") least_in_turn = std::min(least_in_turn, vehicle.speed_mps);
    if (mission.state == "on_line") least_late_on_line = std::min(least_late_on_line, vehicle.speed_mps);
  });
  CHECK(least_in_turn == Approx(1.0));
  CHECK(least_late_on_line > 1.9);
}

TEST_CASE("nothing is commanded before the first estimate") {
  NodeUnderTest<AutopilotNode> autopilot(three_lines(30.0));
  CHECK(autopilot.step_until<msg::Guidance>("command", 1_s).empty());
}

TEST_CASE("lines over a chart are planned when it arrives, or refused with the reason") {
  AutopilotConfig config = three_lines(30.0);
  config.plan.mission.runlines.clear();
  config.plan.mission.auto_plan = AutoPlan{};
  msg::Chart chart;
  chart.west_m = chart.south_m = -400;
  chart.spacing_m = 8;
  chart.height_m = msg::Array<float>({101, 101});
  for (float& height : chart.height_m.flat()) height = -20;
  msg::Estimate estimate;
  {
    NodeUnderTest<AutopilotNode> autopilot(config);
    autopilot.give("estimate", estimate);
    autopilot.give_at("chart", 1_s, chart);
    const auto missions = autopilot.step_until<msg::MissionState>("mission", 1_s);
    REQUIRE(missions.size() == 1);
    CHECK(missions[0].line_count == 5);
  }
  for (float& height : chart.height_m.flat()) height = 5;
  NodeUnderTest<AutopilotNode> autopilot(config);
  autopilot.give_at("chart", 0_s, chart);
  CHECK_THROWS_WITH(
      autopilot.run_until(1_s),
      Catch::Contains("bay.yaml") && Catch::Contains("mission.auto: no room for a survey: no part of the chart"));
}

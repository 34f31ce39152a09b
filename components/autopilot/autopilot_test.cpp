#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "components/autopilot/testing/loop.h"
#include "components/config/config_error.h"

using namespace ensonify;
using namespace ensonify::piloted;
using Catch::WithinAbs;

TEST_CASE("lines are run in order, whole, within 0.1 m of their track; then the run ends") {
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
    CHECK(loop.finished());
  }
}

TEST_CASE("a turn takes about as long as its shortest way") {
  const AutopilotConfig config = three_lines(24.0);  // two planned radii: half a circle
  Loop loop(config, start_of(config.plan, config.plan.mission.runlines));
  int in_turn = 0;
  loop.run_until(600_s,
                 [&](const msg::MissionState& mission, const motion::State&) { in_turn += mission.state == "turn"; });
  const double way_m = 2 * (3.14159 * 12 + config.plan.mission.run_in_m);  // two half circles, then back to the run-ins
  CHECK_THAT(0.1 * in_turn * 2.0, WithinAbs(way_m, 4.0));
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
  CHECK(loop.finished());
}

TEST_CASE("commanded speed is the mission's on a line, a fraction in turns, zero when done") {
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
  config.plan.mission.steps.clear();
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

TEST_CASE("in a current lines are held against it, and run-outs are run") {
  AutopilotConfig config = three_lines(40.0);
  config.plan.mission.run_in_m = 40.0;
  config.plan.mission.run_out_m = 10.0;
  Loop loop(config, start_of(config.plan, config.plan.mission.runlines), {0.5, -0.2});
  std::vector<double> off_m;
  std::set<std::string> states;
  loop.run_until(900_s, [&](const msg::MissionState& mission, const motion::State&) {
    states.insert(mission.state);
    if (mission.state == "on_line") off_m.push_back(std::abs(mission.cross_track_m));
  });
  std::sort(off_m.begin(), off_m.end());
  CHECK(off_m[off_m.size() * 95 / 100] < 1.0);
  CHECK(states == std::set<std::string>{"run_in", "on_line", "run_out", "turn", "done"});
}

TEST_CASE("a line of several legs is followed round its bends, a circuit as often as set") {
  AutopilotConfig config = steps({FollowLine{{{0, 20}, {0, 150}, {100, 150}, {150, 250}}, "bank"}});
  config.plan.mission.repeat = 2;
  Loop loop(config, kUnderWay);
  double worst_m = 0.0;
  std::int64_t last_line = -1;
  double longest_to_go_m = 0.0;
  loop.run_until(900_s, [&](const msg::MissionState& mission, const motion::State&) {
    CHECK(mission.line_count == 2);
    CHECK(mission.line_name == (mission.state.starts_with("turn") || mission.state == "done" ? "" : "bank"));
    if (mission.state != "on_line") return;
    last_line = mission.line;
    worst_m = std::max(worst_m, std::abs(mission.cross_track_m));
    longest_to_go_m = std::max(longest_to_go_m, mission.distance_to_go_m);
  });
  CHECK(last_line == 1);
  // At a bend of 90 degrees the circle leaves a piece a radius before its end, so the next is first seen that far off.
  CHECK(worst_m < 1.3 * 12.0);
  CHECK_THAT(longest_to_go_m, WithinAbs(130.0 + 100.0 + std::hypot(50.0, 100.0), 0.5));
  CHECK(loop.finished());
}

TEST_CASE("an inspection passes on a heading, stays, orbits, sets the sonar and marks") {
  SetSonar sonar;
  sonar.head = "bow";
  sonar.settings.range_m = 30.0;
  Loop loop(steps({PassPlace{{60, 100}, 1.5}, sonar, KeepPlace{Vec2(150, 100), 20.0, 3.0}, SetMark{"wreck"},
                   FollowOrbit{{150, 150}, 25.0, 1.25, true}}),
            kUnderWay);
  const auto& settings = loop.nodes.collect<msg::SonarSettings>("pilot/settings_bow");
  const auto& marks = loop.nodes.collect<msg::Mark>("pilot/mark");
  std::vector<std::string> states;
  std::optional<motion::State> passed;
  double slowest_mps = 9.0, kept_s = 0.0, orbit_s = 0.0, off_circle_m = 0.0;
  loop.run_until(900_s, [&](const msg::MissionState& mission, const motion::State& vehicle) {
    if (states.empty() || states.back() != mission.state) states.push_back(mission.state);
    if (mission.state == "pass") passed = vehicle;
    if (mission.state == "keep") {
      kept_s += mission.distance_to_go_m < 4.5 ? 0.1 : 0.0;
      slowest_mps = std::min(slowest_mps, vehicle.speed_mps);
    }
    if (mission.state == "orbit") {
      orbit_s += 0.1;
      if (orbit_s > 40.0) off_circle_m = std::max(off_circle_m, std::abs(mission.cross_track_m));
    }
  });
  CHECK(states == std::vector<std::string>{"pass", "keep", "orbit", "done"});
  REQUIRE(passed);
  CHECK((passed->position_enu_m.head<2>() - Vec2(60, 100)).norm() < 1.5);
  CHECK_THAT(passed->heading_rad, WithinAbs(1.5, 0.1));
  CHECK_THAT(kept_s, WithinAbs(20.0, 0.5));
  CHECK(slowest_mps < 0.05);
  // 1.25 turns of a circle of 25 m at 2 m/s, and the way onto it.
  CHECK_THAT(orbit_s, WithinAbs(1.25 * 2 * 3.14159 * 25.0 / 2.0, 25.0));
  CHECK(off_circle_m < 0.5);

  REQUIRE(settings.size() == 1);
  CHECK(settings[0].range_m == 30.0);
  CHECK(std::isnan(settings[0].swath_rad));
  REQUIRE(marks.size() == 1);
  CHECK(marks[0].text == "wreck");
  CHECK(std::hypot(marks[0].position_enu_m[0] - 150, marks[0].position_enu_m[1] - 100) < 4.5);
}

TEST_CASE("in a current a station is kept from the run upstream on, a wait from its start") {
  const auto run = [](const KeepPlace& keep) {
    Loop loop(steps({FollowLine{{{0, 20}, {0, 200}}}, keep}), {{0, 0, 0}, 0.0, 2.0, 0.0}, {0.0, 0.5});  // from astern
    int turns = 0;
    double kept_s = 0.0, farthest_m = 0.0;
    const Vec2 place(0, 300);
    loop.run_until(900_s, [&](const msg::MissionState& mission, const motion::State& vehicle) {
      if (mission.state != "keep") return;
      turns += std::cos(vehicle.heading_rad) < -0.9;
      kept_s += 0.1;
      if (mission.distance_to_go_m < 4.5 && turns > 0) {
        farthest_m = std::max(farthest_m, (vehicle.position_enu_m.head<2>() - place).norm());
      }
    });
    CHECK(loop.finished());
    return std::tuple(turns > 0, kept_s, farthest_m);
  };
  const auto [turned, place_s, farthest_m] = run({Vec2(0, 300), 20.0, 3.0});
  CHECK(turned);
  CHECK(place_s > 60.0);
  CHECK(farthest_m < 4.5);
  CHECK_THAT(std::get<1>(run({std::nullopt, 20.0, 3.0})), WithinAbs(20.0, 0.3));
}

TEST_CASE("a turn that leads past a place does not count as keeping it") {
  StationKeeper keeper({}, 0.2, 10.0, 0.1);
  keeper.begin({Vec2(0, 0), 20.0, 3.0}, {50, 50});
  CHECK_FALSE(keeper.kept(0_s, {0, 1}, true));
  CHECK_FALSE(keeper.arrived());
  CHECK_FALSE(keeper.kept(1_s, {0, 1}, false));
  CHECK(keeper.arrived());
  CHECK(keeper.kept(21_s, {9, 9}, false));
}

TEST_CASE("a vehicle waits where its last step has left it") {
  Loop loop(steps({FollowLine{{{0, 20}, {0, 80}}}, KeepPlace{.for_s = 20.0, .within_m = 3.0}}), kUnderWay);
  double begun_s = 0.0, ended_s = 0.0, farthest_m = 0.0;
  loop.run_until(300_s, [&](const msg::MissionState& mission, const motion::State& vehicle) {
    if (mission.state != "keep") return;
    if (begun_s == 0.0) begun_s = seconds(loop.now());
    ended_s = seconds(loop.now());
    farthest_m = std::max(farthest_m, (vehicle.position_enu_m.head<2>() - Vec2(0, 80)).norm());
  });
  CAPTURE(farthest_m);
  CHECK(loop.finished());
  CHECK_THAT(ended_s - begun_s, WithinAbs(20.0, 0.3));
  CHECK(farthest_m <
        7.0);  // 4 m to come to rest from 2 m/s, half a period and the command's delay, and no turning back
}

TEST_CASE("an adaptive survey waits for each next line and ends on command") {
  AutopilotConfig config = steps({FollowLine{{{0, 20}, {0, 100}}}});
  config.plan.mission.adaptive = AdaptivePlan{};
  Loop loop(config, kUnderWay);
  std::optional<msg::NextLine> offered;
  loop.nodes.play<msg::NextLine>("coverage", "next_line", 100_ms,
                                 [&](SimTime) { return std::exchange(offered, std::nullopt); });
  int waited = 0;
  std::vector<std::string> states;
  loop.run_until(600_s, [&](const msg::MissionState& mission, const motion::State&) {
    if (states.empty() || states.back() != mission.state) states.push_back(mission.state);
    if (mission.state != "await_line") return;
    if (++waited % 30 != 0) return;
    msg::NextLine next;
    next.stamp_ns = mission.stamp_ns;
    next.number = mission.line + 1;
    next.done = mission.line == 1;
    next.start_enu_m = {60, 100};
    next.end_enu_m = {60, 20};
    offered = next;
  });
  CHECK(states ==
        std::vector<std::string>{"run_in", "on_line", "await_line", "turn", "run_in", "on_line", "await_line", "done"});
  CHECK(loop.finished());
}

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include "components/autopilot/node.h"
#include "components/runtime/config/config_error.h"
#include "components/runtime/config/default_yaml.h"
#include "components/runtime/testing.h"
#include "kernels/motion/kinematics.h"

using namespace ensonify;
using navigation::Vec2;

namespace {

AutopilotConfig three_lines(double spacing_m) {
  AutopilotConfig config;
  config.plan.scenario_file = "bay.yaml";
  config.plan.limits = {.acceleration_mps2 = 0.5, .deceleration_mps2 = 0.5, .turning_radius_m = 10};
  config.plan.mission.speed_mps = 2.0;
  config.plan.mission.run_in_m = 15.0;
  config.plan.mission.runlines = navigation::lawnmower({0, 0}, 0.3, 150, spacing_m, 3);
  config.plan.mission.steps = steps_of(config.plan.mission.runlines);
  return config;
}

/// The vehicle and navigation of a test: kinematics on one side, a perfect estimate on the other, 0.1 s of delay.
class Loop {
 public:
  Loop(const AutopilotConfig& config, const motion::State& start, const Vec2& current_enu_mps = {0, 0})
      : autopilot(config), limits_(config.plan.limits), state_(start), current_enu_mps_(current_enu_mps) {
    command_ = {start.heading_rad, start.speed_mps, start.position_enu_m.z()};
  }

  /// Runs until the mission is done or `t`; `see(mission state, vehicle state)` at each command.
  template <class See>
  void run_until(SimTime t, See&& see) {
    motion::Command next = command_;
    for (SimTime now = now_; now <= t && !autopilot.finished(); now += 100_ms) {
      msg::Estimate estimate;
      estimate.stamp_ns = now.count();
      estimate.position_enu_m = {state_.position_enu_m.x(), state_.position_enu_m.y(), state_.position_enu_m.z()};
      estimate.enu_from_body = frames::wxyz_of(frames::enu_from_body(frames::Attitude{state_.heading_rad, 0, 0}));
      estimate.velocity_enu_mps = {state_.speed_mps * std::sin(state_.heading_rad) + current_enu_mps_.x(),
                                   state_.speed_mps * std::cos(state_.heading_rad) + current_enu_mps_.y(), 0.0};
      if (uncertain_after) {
        const double sd_m = now < *uncertain_after ? 0.5 : 3.0;
        estimate.position_covariance_enu_m2 = {0.1, 0, 0, 0, sd_m * sd_m, 0, 0, 0, 0.1};
      }
      autopilot.give("estimate", estimate);
      if (bottom) {
        const double range_m = bottom(state_.position_enu_m.y()) + state_.position_enu_m.z();
        autopilot.give("altitude", msg::Altitude{now.count(), !std::isnan(range_m), range_m});
      }
      const auto orders = autopilot.step_until<msg::Guidance>("command", now);
      for (const auto& mission : autopilot.step_until<msg::MissionState>("mission", now)) see(mission, state_);
      command_ = next;
      if (!orders.empty()) next = {orders[0].heading_grid_rad, orders[0].speed_mps, next.height_m};
      if (!orders.empty() && !std::isnan(orders[0].depth_m)) next.height_m = -orders[0].depth_m;
      state_ = motion::advance(state_, command_, 0.1, limits_);
      state_.position_enu_m.head<2>() += 0.1 * current_enu_mps_;
      now_ = now + 100_ms;
    }
  }

  NodeUnderTest<AutopilotNode> autopilot;
  std::function<double(double north_m)> bottom;  // depth, NaN: not heard; given: an altimeter is carried
  std::optional<SimTime> uncertain_after;        // the place to the north is known within 0.5 m, and then within 3 m
  SimTime now() const { return now_; }

 private:
  motion::Limits limits_;
  motion::State state_;
  motion::Command command_;
  Vec2 current_enu_mps_;
  SimTime now_{0};
};

}  // namespace

TEST_CASE("autopilot/default.yaml lists every parameter with its default") {
  Scenario scenario;
  scenario.vehicles.resize(1);
  scenario.mission.steps = steps_of({{{0, 0}, {0, 100}}});
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

namespace {

AutopilotConfig steps(std::vector<MissionStep> steps) {
  AutopilotConfig config = three_lines(40.0);
  config.plan.mission.steps = std::move(steps);
  config.plan.mission.runlines.clear();
  return config;
}

const motion::State kUnderWay{{0, 0, 0}, 0.0, 2.0, 0.0};

/// The states that a mission goes through, each once in a row.
std::vector<std::string> states_of(Loop& loop, SimTime until) {
  std::vector<std::string> states;
  loop.run_until(until, [&](const msg::MissionState& mission, const motion::State&) {
    if (states.empty() || states.back() != mission.state) states.push_back(mission.state);
  });
  return states;
}

}  // namespace

TEST_CASE("in a current lines are held against it, and run-outs are flown") {
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

TEST_CASE("a line of several pieces is flown round its bends, and the circuit as often as told") {
  AutopilotConfig config = steps({FlyLine{{{0, 20}, {0, 150}, {100, 150}, {150, 250}}}});
  config.plan.mission.repeat = 2;
  Loop loop(config, kUnderWay);
  double worst_m = 0.0;
  std::int64_t last_line = -1;
  double longest_to_go_m = 0.0;
  loop.run_until(900_s, [&](const msg::MissionState& mission, const motion::State&) {
    CHECK(mission.line_count == 2);
    if (mission.state != "on_line") return;
    last_line = mission.line;
    worst_m = std::max(worst_m, std::abs(mission.cross_track_m));
    longest_to_go_m = std::max(longest_to_go_m, mission.distance_to_go_m);
  });
  CHECK(last_line == 1);
  // At a bend of 90 degrees the circle leaves a piece a radius before its end, so the next is first seen that far off.
  CHECK(worst_m < 1.3 * 12.0);
  CHECK(longest_to_go_m == Approx(130.0 + 100.0 + std::hypot(50.0, 100.0)).margin(0.5));
  CHECK(loop.autopilot.finished());
}

TEST_CASE("an inspection passes on a heading, stops and stays, orbits, sets the sonar and marks") {
  SetSonar sonar;
  sonar.head = "bow";
  sonar.range_m = 30.0;
  Loop loop(steps({PassPlace{{60, 100}, 1.5}, sonar, KeepPlace{Vec2(150, 100), 20.0, 3.0}, SetMark{"wreck"},
                   FlyOrbit{{150, 150}, 25.0, 1.25, true}}),
            kUnderWay);
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
  CHECK(passed->heading_rad == Approx(1.5).margin(0.1));
  CHECK(kept_s == Approx(20.0).margin(0.5));
  CHECK(slowest_mps < 0.05);
  // 1.25 turns of a circle of 25 m at 2 m/s, and the way onto it.
  CHECK(orbit_s == Approx(1.25 * 2 * 3.14159 * 25.0 / 2.0).margin(25.0));
  CHECK(off_circle_m < 0.5);

  const auto settings = loop.autopilot.step_until<msg::SonarSettings>("settings_bow", loop.now());
  REQUIRE(settings.size() == 1);
  CHECK(settings[0].range_m == 30.0);
  CHECK(std::isnan(settings[0].swath_rad));
  const auto marks = loop.autopilot.step_until<msg::Mark>("mark", loop.now());
  REQUIRE(marks.size() == 1);
  CHECK(marks[0].text == "wreck");
  CHECK(std::hypot(marks[0].position_enu_m[0] - 150, marks[0].position_enu_m[1] - 100) < 4.5);
}

TEST_CASE("in a current a place counts as kept from the way up the stream, a wait from where it begins") {
  const auto run = [](const KeepPlace& keep) {
    Loop loop(steps({FlyLine{{{0, 20}, {0, 200}}}, keep}), {{0, 0, 0}, 0.0, 2.0, 0.0}, {0.0, 0.5});  // from astern
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
    CHECK(loop.autopilot.finished());
    return std::tuple(turns > 0, kept_s, farthest_m);
  };
  const auto [turned, place_s, farthest_m] = run({Vec2(0, 300), 20.0, 3.0});
  CHECK(turned);
  CHECK(place_s > 60.0);
  CHECK(farthest_m < 4.5);
  CHECK(std::get<1>(run({std::nullopt, 20.0, 3.0})) == Approx(20.0).margin(0.3));
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

TEST_CASE("a vehicle follows the bottom by its altimeter and climbs first where it is too low") {
  AutopilotConfig config = steps({FlyLine{{{0, 20}, {0, 600}}}});
  config.plan.mission.depth_m = 10.0;
  config.plan.mission.altitude_m = 5.0;
  config.plan.mission.least_altitude_m = 2.0;
  Loop loop(config, {{0, 0, -10}, 0.0, 2.0, 0.0});
  loop.bottom = [](double north_m) { return 20.0 + 3.0 * std::sin(north_m / 60.0); };  // slopes up to 1 in 20
  double least_m = 99.0, worst_m = 0.0;
  loop.run_until(400_s, [&](const msg::MissionState&, const motion::State& vehicle) {
    const double altitude_m = loop.bottom(vehicle.position_enu_m.y()) + vehicle.position_enu_m.z();
    if (vehicle.position_enu_m.y() < 100.0) return;
    least_m = std::min(least_m, altitude_m);
    worst_m = std::max(worst_m, std::abs(altitude_m - 5.0));
  });
  CHECK(loop.autopilot.finished());
  CHECK(least_m > 4.0);
  CHECK(worst_m < 1.5);  // 0.1 m/s of rise, looked ahead for 7 s, and awaited as long where it falls
}

TEST_CASE("a mission's depth is held from any start, and nothing that floats has one") {
  AutopilotConfig config = steps({FlyLine{{{0, 20}, {0, 200}}}});
  config.plan.mission.depth_m = 6.0;
  Loop loop(config, {{0, 0, -1}, 0.0, 2.0, 0.0});
  double up_m = 0.0;
  loop.run_until(60_s,
                 [&](const msg::MissionState&, const motion::State& vehicle) { up_m = vehicle.position_enu_m.z(); });
  CHECK(up_m == Approx(-6.0).margin(1e-6));

  Scenario scenario;  // one vehicle dives, but it is the other that is flown
  scenario.vehicles.resize(2);
  scenario.vehicles[0].name = "auv";
  scenario.vehicles[1].name = "boat";
  scenario.vehicles[1].floats.emplace();
  scenario.mission = config.plan.mission;
  auto from = ConfigReader::from_text("vehicle: boat", "pilot.yaml");
  AutopilotConfig::read(from, scenario, "pilot");
  CHECK_THROWS_WITH(from.finish(), "pilot.yaml:1:1: the mission's depth_m needs a vehicle that dives; boat floats");
}

TEST_CASE("a mission that takes too long is given up at the surface") {
  AutopilotConfig config = steps({FlyLine{{{0, 20}, {0, 5000}}}});
  config.plan.mission.depth_m = 10.0;
  config.plan.mission.abort.after_s = 100.0;
  Loop loop(config, {{0, 0, -10}, 0.0, 2.0, 0.0});
  const auto states = states_of(loop, 600_s);
  CHECK(states.back() == "abort");
  CHECK(loop.autopilot.finished());
  // 9 m up at 0.5 m/s: 18 s, and the command's delay.
  CHECK(seconds(loop.now()) == Approx(118.0).margin(2.0));
}

TEST_CASE("a mission whose place becomes too uncertain is given up then") {
  AutopilotConfig config = steps({FlyLine{{{0, 20}, {0, 5000}}}});
  config.plan.mission.abort.position_sd_m = 2.0;
  Loop loop(config, {{0, 0, 0}, 0.0, 2.0, 0.0});
  loop.uncertain_after = 50_s;
  CHECK(states_of(loop, 600_s).back() == "abort");
  CHECK(loop.autopilot.finished());
  CHECK(seconds(loop.now()) == Approx(50.0).margin(0.3));  // it is at the surface already
  const auto health = loop.autopilot.step_until<msg::Health>("health", loop.now());
  REQUIRE_FALSE(health.empty());
  CHECK(health.back().message == "mission given up: the place is less certain than abort.position_sd_m");
}

TEST_CASE("a mission is given up when its vehicle is below the obstacle floor for too long, and not before") {
  AutopilotConfig config = steps({FlyLine{{{0, 20}, {0, 200}}}});
  config.plan.mission.depth_m = 10.0;
  config.plan.mission.least_altitude_m = 4.0;
  const auto flown = [&](double too_low_s) {
    config.plan.mission.abort.too_low_s = too_low_s;
    Loop loop(config, {{0, 0, -10}, 0.0, 2.0, 0.0});
    loop.bottom = [](double north_m) { return north_m < 100.0 ? 20.0 : 12.0; };  // a step of 8 m: 2 m are missing
    return states_of(loop, 600_s).back();
  };
  // 2 m at 0.5 m/s are 4 s, and the climb takes some more to begin.
  CHECK(flown(3.0) == "abort");
  CHECK(flown(15.0) == "done");
}

TEST_CASE("a vehicle waits where its last step has left it") {
  Loop loop(steps({FlyLine{{{0, 20}, {0, 80}}}, KeepPlace{.for_s = 20.0, .within_m = 3.0}}), kUnderWay);
  double begun_s = 0.0, ended_s = 0.0, farthest_m = 0.0;
  loop.run_until(300_s, [&](const msg::MissionState& mission, const motion::State& vehicle) {
    if (mission.state != "keep") return;
    if (begun_s == 0.0) begun_s = seconds(loop.now());
    ended_s = seconds(loop.now());
    farthest_m = std::max(farthest_m, (vehicle.position_enu_m.head<2>() - Vec2(0, 80)).norm());
  });
  CAPTURE(farthest_m);
  CHECK(loop.autopilot.finished());
  CHECK(ended_s - begun_s == Approx(20.0).margin(0.3));
  CHECK(farthest_m <
        7.0);  // 4 m to come to rest from 2 m/s, half a period and the command's delay, and no turning back
}

TEST_CASE("without a bottom to keep it from, an altitude or an obstacle floor is told as not kept") {
  AutopilotConfig config = steps({FlyLine{{{0, 20}, {0, 100}}}});
  const auto healths = [&](double heard_until_m) {
    Loop loop(config, {{0, 0, 0}, 0.0, 2.0, 0.0});
    loop.bottom = [=](double north_m) { return north_m < heard_until_m ? 20.0 : std::nan(""); };
    states_of(loop, 600_s);
    std::vector<std::string> told;
    for (const auto& health : loop.autopilot.step_until<msg::Health>("health", loop.now()))
      told.push_back(health.state + " " + health.message);
    return told;
  };
  const std::vector<std::string> deaf = {
      "degraded no bottom heard for 10 s: neither altitude_m nor least_altitude_m is kept"};
  config.plan.mission.depth_m = 5.0;
  CHECK(healths(0.0).empty());  // neither is wanted
  config.plan.mission.least_altitude_m = 3.0;
  CHECK(healths(1000.0).empty());
  CHECK(healths(0.0) == deaf);
  CHECK(healths(40.0) == deaf);
  config.plan.mission.least_altitude_m = 0.0;
  config.plan.mission.altitude_m = 6.0;
  CHECK(healths(0.0) == deaf);
}

TEST_CASE("an altimeter is needed by missions that follow the bottom or have an obstacle floor") {
  Mission mission = steps({FlyLine{{{0, 20}, {0, 100}}}}).plan.mission;
  mission.depth_m = 5.0;
  mission.abort.after_s = 100.0;
  CHECK_FALSE(needs_altimeter(mission));
  mission.steps.push_back(GoAt{.altitude_m = 4.0});
  CHECK(needs_altimeter(mission));
  mission.steps.clear();
  mission.least_altitude_m = 2.0;
  CHECK(needs_altimeter(mission));
}

TEST_CASE("an adaptive survey waits for each next line and ends when told") {
  AutopilotConfig config = steps({FlyLine{{{0, 20}, {0, 100}}}});
  config.plan.mission.adaptive = AdaptivePlan{};
  Loop loop(config, kUnderWay);
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
    loop.autopilot.give("next_line", next);
  });
  CHECK(states ==
        std::vector<std::string>{"run_in", "on_line", "await_line", "turn", "run_in", "on_line", "await_line", "done"});
  CHECK(loop.autopilot.finished());
}

TEST_CASE("a current stronger than the vehicle is told, and the mission given up when nothing comes nearer") {
  // Against the line it is carried back, across it off to the side while it still makes way along the line.
  for (const Vec2& current : {Vec2(0.0, -2.5), Vec2(4.0, 0.0)}) {
    AutopilotConfig config = three_lines(30.0);
    config.plan.mission.runlines = navigation::lawnmower({0, 0}, 0.0, 2000, 30, 1);
    config.plan.mission.steps = steps_of(config.plan.mission.runlines);
    config.patience_s = 120.0;
    Loop loop(config, start_of(config.plan, config.plan.mission.runlines), current);
    std::string last;
    loop.run_until(900_s, [&](const msg::MissionState& mission, const motion::State&) { last = mission.state; });
    INFO("current " << current.transpose() << ", ended at " << seconds(loop.now()) << " s");
    CHECK(loop.autopilot.finished());
    CHECK(last == "abort");
    CHECK(seconds(loop.now()) < 200.0);
    const auto health = loop.autopilot.step_until<msg::Health>("health", loop.now());
    REQUIRE(health.size() == 2);  // held up, then lost
    CHECK(health[0].state == "degraded");
    CHECK(health[1].state == "failed");
    CHECK(health.back().message ==
          "mission given up: no metre nearer to the goal in patience_s: the current may be "
          "stronger than the vehicle");
  }
}

TEST_CASE("a vehicle that is slow against a current is waited for") {
  AutopilotConfig config = three_lines(30.0);
  config.patience_s = 60.0;
  Loop loop(config, start_of(config.plan, config.plan.mission.runlines), {0.3, -1.8});
  std::string last;
  loop.run_until(4000_s, [&](const msg::MissionState& mission, const motion::State&) { last = mission.state; });
  CHECK(loop.autopilot.finished());
  CHECK(last == "done");
}

// What a mission is held to or given up for: the bottom, depths, times, a place too uncertain, a current too strong.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "components/autopilot/testing/loop.h"
#include "components/config/config_reader.h"

using namespace ensonify;
using namespace ensonify::piloted;
using Catch::WithinAbs;

TEST_CASE("a vehicle follows the bottom by altimeter, and climbs first where it is too low") {
  AutopilotConfig config = steps({FollowLine{{{0, 20}, {0, 600}}}});
  config.plan.mission.depth_m = 10.0;
  config.plan.mission.altitude_m = 5.0;
  config.plan.mission.least_altitude_m = 2.0;
  Loop loop(config, {{0, 0, -10}, 0.0, 2.0, 0.0});
  loop.boat.bottom = [](double north_m) { return 20.0 + 3.0 * std::sin(north_m / 60.0); };  // slopes up to 1 in 20
  double least_m = 99.0, worst_m = 0.0;
  loop.run_until(400_s, [&](const msg::MissionState&, const motion::State& vehicle) {
    const double altitude_m = loop.boat.bottom(vehicle.position_enu_m.y()) + vehicle.position_enu_m.z();
    if (vehicle.position_enu_m.y() < 100.0) return;
    least_m = std::min(least_m, altitude_m);
    worst_m = std::max(worst_m, std::abs(altitude_m - 5.0));
  });
  CHECK(loop.finished());
  CHECK(least_m > 4.0);
  CHECK(worst_m < 1.5);  // 0.1 m/s of rise, looked ahead for 7 s, and awaited as long where it falls
}

TEST_CASE("a mission's depth is held from any start, and nothing that floats has one") {
  AutopilotConfig config = steps({FollowLine{{{0, 20}, {0, 200}}}});
  config.plan.mission.depth_m = 6.0;
  Loop loop(config, {{0, 0, -1}, 0.0, 2.0, 0.0});
  double up_m = 0.0;
  loop.run_until(60_s,
                 [&](const msg::MissionState&, const motion::State& vehicle) { up_m = vehicle.position_enu_m.z(); });
  CHECK_THAT(up_m, WithinAbs(-6.0, 1e-6));

  World world;  // one vehicle dives, but it is the other that is steered
  world.vehicles.resize(2);
  world.vehicles[0].name = "auv";
  world.vehicles[1].name = "boat";
  world.vehicles[1].floats.emplace();
  world.mission = config.plan.mission;
  auto from = ConfigReader::from_text("vehicle: boat", "pilot.yaml");
  AutopilotConfig::read(from, world, "pilot");
  CHECK_THROWS_WITH(from.finish(), "pilot.yaml:1:1: the mission's depth_m needs a vehicle that dives; boat floats");
}

TEST_CASE("a mission that takes too long is given up at the surface") {
  AutopilotConfig config = steps({FollowLine{{{0, 20}, {0, 5000}}}});
  config.plan.mission.depth_m = 10.0;
  config.plan.mission.abort.after_s = 100.0;
  Loop loop(config, {{0, 0, -10}, 0.0, 2.0, 0.0});
  const auto states = states_of(loop, 600_s);
  CHECK(states.back() == "abort");
  CHECK(loop.finished());
  // 9 m up at 0.5 m/s: 18 s, and the command's delay.
  CHECK_THAT(seconds(loop.now()), WithinAbs(118.0, 2.0));
}

TEST_CASE("a mission whose place becomes too uncertain is given up then") {
  AutopilotConfig config = steps({FollowLine{{{0, 20}, {0, 5000}}}});
  config.plan.mission.abort.position_sd_m = 2.0;
  Loop loop(config, {{0, 0, 0}, 0.0, 2.0, 0.0});
  loop.boat.uncertain_after = 50_s;
  const auto& health = loop.nodes.collect<msg::Health>("pilot/health");
  CHECK(states_of(loop, 600_s).back() == "abort");
  CHECK(loop.finished());
  CHECK_THAT(seconds(loop.now()), WithinAbs(50.0, 0.3));  // it is at the surface already
  REQUIRE_FALSE(health.empty());
  CHECK(health.back().message == "mission given up: the place is less certain than abort.position_sd_m");
}

TEST_CASE("a mission is aborted after too long below the obstacle floor, and not before") {
  AutopilotConfig config = steps({FollowLine{{{0, 20}, {0, 200}}}});
  config.plan.mission.depth_m = 10.0;
  config.plan.mission.least_altitude_m = 4.0;
  const auto final_state = [&](double too_low_s) {
    config.plan.mission.abort.too_low_s = too_low_s;
    Loop loop(config, {{0, 0, -10}, 0.0, 2.0, 0.0});
    loop.boat.bottom = [](double north_m) { return north_m < 100.0 ? 20.0 : 12.0; };  // a step of 8 m: 2 m are missing
    return states_of(loop, 600_s).back();
  };
  // 2 m at 0.5 m/s are 4 s, and the climb takes some more to begin.
  CHECK(final_state(3.0) == "abort");
  CHECK(final_state(15.0) == "done");
}

TEST_CASE("without a bottom, altitude and obstacle floor are reported as not kept") {
  AutopilotConfig config = steps({FollowLine{{{0, 20}, {0, 100}}}});
  const auto healths = [&](double detected_until_m) {
    Loop loop(config, {{0, 0, 0}, 0.0, 2.0, 0.0});
    loop.boat.bottom = [=](double north_m) { return north_m < detected_until_m ? 20.0 : std::nan(""); };
    const auto& all = loop.nodes.collect<msg::Health>("pilot/health");
    states_of(loop, 600_s);
    std::vector<std::string> reported;
    for (const auto& health : all) reported.push_back(health.state + " " + health.message);
    return reported;
  };
  const std::vector<std::string> bottom_lost = {
      "degraded no bottom detected for 10 s: neither altitude_m nor least_altitude_m is kept"};
  config.plan.mission.depth_m = 5.0;
  CHECK(healths(0.0).empty());  // neither is wanted
  config.plan.mission.least_altitude_m = 3.0;
  CHECK(healths(1000.0).empty());
  CHECK(healths(0.0) == bottom_lost);
  CHECK(healths(40.0) == bottom_lost);
  config.plan.mission.least_altitude_m = 0.0;
  config.plan.mission.altitude_m = 6.0;
  CHECK(healths(0.0) == bottom_lost);
}

TEST_CASE("missions that follow the bottom or have an obstacle floor need an altimeter") {
  Mission mission = steps({FollowLine{{{0, 20}, {0, 100}}}}).plan.mission;
  mission.depth_m = 5.0;
  mission.abort.after_s = 100.0;
  CHECK_FALSE(needs_altimeter(mission));
  mission.steps.push_back(GoAt{.altitude_m = 4.0});
  CHECK(needs_altimeter(mission));
  mission.steps.clear();
  mission.least_altitude_m = 2.0;
  CHECK(needs_altimeter(mission));
}

TEST_CASE("a current stronger than the vehicle is reported, and the mission is aborted") {
  // Against the line it is carried back, across it off to the side while it still makes way along the line.
  for (const Vec2& current : {Vec2(0.0, -2.5), Vec2(4.0, 0.0)}) {
    AutopilotConfig config = three_lines(30.0);
    config.plan.mission.runlines = runlines::lawnmower({0, 0}, 0.0, 2000, 30, 1);
    config.plan.mission.steps = steps_of(config.plan.mission.runlines);
    config.patience_s = 120.0;
    Loop loop(config, start_of(config.plan, config.plan.mission.runlines), current);
    const auto& health = loop.nodes.collect<msg::Health>("pilot/health");
    std::string last;
    loop.run_until(900_s, [&](const msg::MissionState& mission, const motion::State&) { last = mission.state; });
    INFO("current " << current.transpose() << ", ended at " << seconds(loop.now()) << " s");
    CHECK(loop.finished());
    CHECK(last == "abort");
    CHECK(seconds(loop.now()) < 200.0);
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
  CHECK(loop.finished());
  CHECK(last == "done");
}

// What an autopilot does while another pilot steers its vehicle, and when it gets the vehicle back.
#include <catch2/catch.hpp>

#include "components/autopilot/testing/loop.h"

using namespace ensonify;
using namespace ensonify::piloted;

namespace {

/// A boat on its way north along a line of 300 m, which an agent has from 20 s to 50 s; then the vehicle is the
/// autopilot's again, because of `why`.
struct Relieved {
  explicit Relieved(WhenSilent when_silent, std::string why, SimTime until = 250_s) {
    AutopilotConfig config = steps({FollowLine{{{0, 20}, {0, 320}}}});
    config.plan.mission.when_silent = when_silent;
    config.plan.mission.home_enu_m = home;
    Loop loop(config, kUnderWay);
    loop.nodes.play<msg::Helm>("auv", "helm", 1_s, [why](SimTime now) -> std::optional<msg::Helm> {
      if (now < 20_s) return msg::Helm{now.count(), "pilot", {"agent", "pilot"}, "commands", 0};
      if (now < 50_s) return msg::Helm{now.count(), "agent", {"agent", "pilot"}, "commands", 0};
      return msg::Helm{now.count(), "pilot", {"agent", "pilot"}, why, 0};
    });
    loop.run_until(until, [&](const msg::MissionState& mission, const motion::State& boat) {
      if (states.empty() || states.back() != mission.state) states.push_back(mission.state);
      place = boat.position_enu_m.head<2>();
      if (loop.now() == 50_s) at_relief = place;
      speed_mps = boat.speed_mps;
    });
    finished = loop.finished();
  }

  Vec2 home{-60, -30}, place{0, 0}, at_relief{0, 0};
  double speed_mps = 0.0;
  std::vector<std::string> states;
  bool finished = false;
};

}  // namespace

TEST_CASE("an autopilot stands by while another pilot steers, and runs its line again when it is handed back") {
  for (const WhenSilent when_silent : {WhenSilent::kGoOn, WhenSilent::kHold}) {
    const Relieved boat(when_silent, "hand_back", 600_s);
    CHECK(boat.states ==
          std::vector<std::string>{"run_in", "on_line", "stand_by", "turn", "run_in", "on_line", "done"});
    CHECK(boat.finished);
  }
}

TEST_CASE("after a pilot that fell silent the mission goes on, or the vehicle holds, or goes home") {
  CHECK(Relieved(WhenSilent::kGoOn, "silent", 600_s).finished);

  const Relieved holding(WhenSilent::kHold, "silent");
  CHECK(holding.states == std::vector<std::string>{"run_in", "on_line", "stand_by", "keep"});
  CHECK((holding.place - holding.at_relief).norm() < 10.0);
  CHECK(holding.speed_mps < 0.3);

  const Relieved home(WhenSilent::kHome, "silent");
  CHECK(home.states.back() == "keep");
  CHECK((home.place - home.home).norm() < 6.0);
}

TEST_CASE("a mission is given up after a pilot that fell silent, when it says so") {
  AutopilotConfig config = steps({FollowLine{{{0, 20}, {0, 320}}}});
  config.plan.mission.when_silent = WhenSilent::kSurface;
  config.plan.mission.depth_m = 8.0;
  Loop loop(config, {{0, 0, -8}, 0.0, 2.0, 0.0});
  loop.nodes.play<msg::Helm>("auv", "helm", 1_s, [](SimTime now) -> std::optional<msg::Helm> {
    return msg::Helm{now.count(), now < 20_s ? "agent" : "pilot", {"agent", "pilot"}, "silent", 0};
  });
  const auto& health = loop.nodes.collect<msg::Health>("pilot/health");
  CHECK(states_of(loop, 100_s) == std::vector<std::string>{"stand_by", "abort"});
  CHECK(loop.finished());
  CHECK(health.back().message == "mission given up: the pilot that steered fell silent");
}

TEST_CASE("the helm of a vehicle that an autopilot may not steer is none of its business") {
  Loop loop(steps({FollowLine{{{0, 20}, {0, 120}}}}), kUnderWay);
  loop.nodes.play<msg::Helm>("other", "helm", 1_s, [](SimTime now) -> std::optional<msg::Helm> {
    return msg::Helm{now.count(), "agent", {"agent", "its_pilot"}, "commands", 0};
  });
  CHECK(states_of(loop, 300_s) == std::vector<std::string>{"run_in", "on_line", "done"});
}

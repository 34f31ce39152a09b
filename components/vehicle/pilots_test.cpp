#include "components/vehicle/pilots.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "components/runtime/testing/node_under_test.h"
#include "components/vehicle/node.h"

using namespace ensonify;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

msg::Guidance order(double speed_mps, bool hand_back = false) { return {0, 0.0, speed_mps, kNaN, "", hand_back}; }

double speed_mps(const std::optional<Order>& order) { return std::get<msg::Guidance>(order.value()).speed_mps; }

msg::Actuators actuators(std::vector<double> propeller_rps, std::vector<double> fin_rad, bool hand_back = false) {
  msg::Actuators order;
  order.propeller_rps = msg::Array<double>::of(std::move(propeller_rps));
  order.fin_rad = msg::Array<double>::of(std::move(fin_rad));
  order.hand_back = hand_back;
  return order;
}

/// An agent that is given up after 2 s, before an autopilot.
std::vector<PilotKeys> agent_and_pilot(bool returns = true) { return {{"agent", 2.0, returns}, {"pilot", {}, true}}; }

/// Who steers at each second, while the pilot orders all the time and the agent when `heard` says so.
template <class Heard>
std::vector<std::string> helms(Pilots& pilots, int seconds, Heard&& heard) {
  std::vector<std::string> helms;
  for (int tenth = 0; tenth < 10 * seconds; ++tenth) {
    const SimTime now = tenth * 100_ms;
    pilots.take(now, "pilot", order(1.0));
    if (heard(0.1 * tenth)) pilots.take(now, "agent", order(2.0));
    pilots.update(now);
    if (tenth % 10 == 9) helms.push_back(pilots.steered_by());
  }
  return helms;
}

}  // namespace

TEST_CASE("the first that is heard steers, and the next when it has been silent for its time") {
  Pilots pilots(agent_and_pilot());
  CHECK(helms(pilots, 8, [](double t_s) { return t_s > 1.95 && t_s < 3.95; }) ==
        std::vector<std::string>{"pilot", "pilot", "agent", "agent", "agent", "pilot", "pilot", "pilot"});
  CHECK(pilots.why() == "silent");
}

TEST_CASE("one that was silent steers again when it has been heard for as long without a gap") {
  const auto gap = [](double t_s) { return t_s < 0.95 || t_s > 3.95; };
  Pilots pilots(agent_and_pilot());
  CHECK(helms(pilots, 8, gap) ==
        std::vector<std::string>{"agent", "agent", "pilot", "pilot", "pilot", "pilot", "agent", "agent"});
  CHECK(pilots.why() == "commands");
  Pilots once(agent_and_pilot(false));
  CHECK(helms(once, 8, gap).back() == "pilot");
}

TEST_CASE("a pilot that stutters does not steer in turns with another") {
  Pilots pilots(agent_and_pilot());
  int changes = 0;
  std::string before;
  for (int tenth = 0; tenth < 600; ++tenth) {
    const SimTime now = tenth * 100_ms;
    pilots.take(now, "pilot", order(1.0));
    if (tenth % 30 == 0) pilots.take(now, "agent", order(2.0));  // every 3 s
    changes += int{pilots.update(now)};
  }
  CHECK(changes == 2);  // to the agent, and away from it
}

TEST_CASE("a pilot hands the vehicle back, and takes it with its next order") {
  Pilots pilots(agent_and_pilot());
  pilots.take(0_s, "pilot", order(1.0));
  pilots.take(0_s, "agent", order(2.0));
  CHECK(pilots.update(0_s));
  CHECK(speed_mps(pilots.take_command()) == 2.0);
  pilots.take(1_s, "pilot", order(1.0));
  pilots.take(1_s, "agent", order(2.0, true));
  CHECK(pilots.update(1_s));
  CHECK(pilots.steered_by() == "pilot");
  CHECK(pilots.why() == "hand_back");
  CHECK(speed_mps(pilots.take_command()) == 1.0);
  pilots.take(1_s + 100_ms, "agent", order(2.0));
  CHECK(pilots.update(1_s + 100_ms));
  CHECK(pilots.steered_by() == "agent");
}

TEST_CASE("when nobody steers any more the vehicle stops on its heading") {
  Pilots pilots({{"agent", 1.0, true}});
  CHECK_FALSE(pilots.update(0_s));
  CHECK_FALSE(pilots.take_command());
  pilots.take(1_s, "agent", {0, 0.7, 2.0, 5.0});
  pilots.update(1_s);
  CHECK(pilots.take_command());
  CHECK(pilots.update(2_s));
  CHECK(pilots.steered_by().empty());
  const auto order = pilots.take_command();
  REQUIRE(order);
  const auto* stop = std::get_if<msg::Guidance>(&*order);
  REQUIRE(stop);
  CHECK(stop->speed_mps == 0.0);
  CHECK(stop->heading_grid_rad == 0.7);
  CHECK(stop->depth_m == 5.0);
  CHECK_FALSE(pilots.take_command());
}

TEST_CASE("what cannot be meant is refused") {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  CHECK(refusal_of({0, 0.0, 1.0}, "auv").empty());
  CHECK(refusal_of({0, -7.0, 1.0, 30.0, "auv"}, "auv").empty());
  CHECK(refusal_of({0, 0.0, 1.0, kNaN, "boat"}, "auv") == "for_another_vehicle");
  for (const msg::Guidance& wrong : {msg::Guidance{0, kNaN, 1.0}, {0, 0.0, kInf}, {0, 0.0, 1.0, kInf}}) {
    CHECK(refusal_of(wrong, "auv") == "not_finite");
  }
  for (const msg::Guidance& wrong :
       {msg::Guidance{0, 90.0, 1.0}, {0, 0.0, -0.1}, {0, 0.0, 101.0}, {0, 0.0, 1.0, -0.1}, {0, 0.0, 1.0, 11'001.0}}) {
    CHECK(refusal_of(wrong, "auv") == "out_of_range");
  }
}

TEST_CASE("orders of actuators are refused that are no numbers, beyond what they can, or of others") {
  motion::HydrodynamicParameters body;
  body.propellers.resize(1);
  body.propellers[0].fastest_rps = 25.0;
  body.fins.resize(2);
  for (motion::Fin& fin : body.fins) fin.largest_rad = 0.25;
  CHECK(refusal_of(actuators({-25.0}, {0.25, -0.25}), "auv", body).empty());
  CHECK(refusal_of(actuators({}, {}, true), "auv", body).empty());
  CHECK(refusal_of(actuators({kNaN}, {0.0, 0.0}), "auv", body) == "not_finite");
  CHECK(refusal_of(actuators({1.0}, {0.0, -std::numeric_limits<double>::infinity()}), "auv", body) == "not_finite");
  CHECK(refusal_of(actuators({25.1}, {0.0, 0.0}), "auv", body) == "out_of_range");
  CHECK(refusal_of(actuators({1.0}, {0.0, 0.26}), "auv", body) == "out_of_range");
  CHECK(refusal_of(actuators({1.0}, {0.0}), "auv", body) == "of_other_actuators");
  CHECK(refusal_of(actuators({1.0, 1.0}, {0.0, 0.0}), "auv", body) == "of_other_actuators");
  msg::Actuators of_another = actuators({1.0}, {0.0, 0.0});
  of_another.vehicle = "boat";
  CHECK(refusal_of(of_another, "auv", body) == "for_another_vehicle");
}

TEST_CASE("when nobody orders its actuators any more the vehicle is to stop") {
  Pilots pilots({{"agent", 1.0, true, PilotKeys::By::kActuators}});
  pilots.take(1_s, "agent", actuators({5.0}, {0.1}));
  pilots.update(1_s);
  CHECK(std::get<msg::Actuators>(pilots.take_command().value()).fin_rad.data()[0] == 0.1);
  CHECK(pilots.update(2_s));
  CHECK(std::holds_alternative<Stop>(pilots.take_command().value()));
  CHECK_FALSE(pilots.take_command());
}

TEST_CASE("a vehicle says who steers it, each second and when that changes, and counts what it refuses") {
  VehicleConfig config;
  config.limits = {.acceleration_mps2 = 0.5, .deceleration_mps2 = 0.5, .turning_radius_m = 10};
  config.name = "auv";
  config.start = motion::State{{0, 0, 0}, 0.0, 1.0};
  config.steered_by = agent_and_pilot();
  NodeUnderTest<VehicleNode> vehicle(config);
  const auto give = [&](const char* topic, SimTime t, double speed_mps, const char* to = "") {
    vehicle.give(topic, msg::Guidance{t.count(), 0.0, speed_mps, kNaN, to});
  };
  for (SimTime t = 0_s; t < 6_s; t += 100_ms) {
    give("pilot/command", t, 1.0);
    if (t < 1_s) give("agent/command", t, 3.0);
    if (t == 4_s) give("agent/command", t, 3.0, "boat");
  }
  const auto helms = vehicle.step_until<msg::Helm>("helm", 6_s);
  std::vector<std::string> steered_by;
  for (const msg::Helm& helm : helms) {
    CHECK(helm.pilots == std::vector<std::string>{"agent", "pilot"});
    if (steered_by.empty() || steered_by.back() != helm.steered_by) steered_by.push_back(helm.steered_by);
  }
  CHECK(steered_by == std::vector<std::string>{"", "agent", "pilot"});
  CHECK(helms.size() == 8);  // at 0 s, 0.1 s and each second; it changes at 3 s: 0.9 s + 0.1 s + 2 s
  CHECK(helms.back().refused == 1);
  const auto health = vehicle.step_until<msg::Health>("health", 6_s);
  REQUIRE_FALSE(health.empty());
  CHECK(health.back().message == "a command of agent was refused: for_another_vehicle");
  CHECK(health.back().counters.at(0).name == "commands_for_another_vehicle");
}

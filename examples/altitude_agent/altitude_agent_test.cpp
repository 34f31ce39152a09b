#include <catch2/catch.hpp>

#include "components/runtime/testing/node_under_test.h"
#include "examples/altitude_agent/node.h"

using namespace ensonify;

TEST_CASE("it says nothing before it knows altitude and depth") {
  NodeUnderTest<AltitudeAgentNode> agent(AltitudeAgentConfig{});
  agent.give("depth", msg::Depth{0, 20.0});
  CHECK(agent.step_until<msg::Guidance>("command", 1_s).empty());
}

TEST_CASE("ten times a second it orders a depth that brings it to its altitude") {
  NodeUnderTest<AltitudeAgentNode> agent(AltitudeAgentConfig{});
  agent.give("depth", msg::Depth{0, 20.0});
  agent.give("altitude", msg::Altitude{0, true, 9.0}, msg::Altitude{(500_ms).count(), false, 0.0});
  const auto orders = agent.step_until<msg::Guidance>("command", 1_s);
  REQUIRE(orders.size() == 11);
  CHECK(orders.back().depth_m == Approx(23.0));  // what was not received does not count
  CHECK(orders.back().speed_mps == 1.5);
}

TEST_CASE("it never orders less than half a metre of depth") {
  NodeUnderTest<AltitudeAgentNode> agent(AltitudeAgentConfig{});
  agent.give("depth", msg::Depth{0, 1.0});
  agent.give("altitude", msg::Altitude{0, true, 2.0});
  CHECK(agent.step_until<msg::Guidance>("command", 1_s).back().depth_m == 0.5);
}

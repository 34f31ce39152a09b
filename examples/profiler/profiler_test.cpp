#include <catch2/catch.hpp>
#include <cmath>

#include "components/runtime/testing/node_under_test.h"
#include "components/sonar/testing/config.h"
#include "components/sonar/testing/seabed.h"
#include "examples/profiler/node.h"
#include "kernels/seabed/backscatter.h"
#include "messages/motion.h"
#include "scenarios/world/testing/default_yaml.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

/// A profiler at rest at the surface, over a level seabed `depth_m` below.
struct AtRest {
  NodeUnderTest<ProfilerNode> head;

  explicit AtRest(double depth_m) : head(over_lambert()) {
    for (SimTime t{0}; t <= 3_s; t += 20_ms) {
      msg::Pose pose;
      pose.stamp_ns = t.count();
      pose.enu_from_body = frames::wxyz_of(frames::enu_from_ned());
      head.give("pose", pose);
    }
    head.give("tile", tile_of(64, 0.5, [=](double, double) { return -depth_m; }));
  }

  static ProfilerConfig over_lambert() {
    ProfilerConfig config;
    world_of(config).water.profile.sound_speed_mps = 1500.0;
    world_of(config).seabed.sediments = {{0, seabed::Lambert{-25.0}}};
    return config;
  }
};

}  // namespace

TEST_CASE("profiler/default.yaml lists every parameter with its default") {
  CHECK(default_yaml_fault<ProfilerConfig>("bow", world_with("bow")) == "");
}

TEST_CASE("a profiler finds a level seabed within half a pulse") {
  AtRest at_rest(12.0);
  const auto bottoms = at_rest.head.step_until<msg::BottomTrack>("bottom", 1_s);
  REQUIRE(bottoms.size() > 5);
  // Half a pulse of 50 us: 19 mm; the beam's edge is 1.3 mm farther than its axis.
  for (const auto& bottom : bottoms) {
    REQUIRE(bottom.valid);
    CHECK_THAT(bottom.altitude_m, WithinAbs(12.0, 0.02));
  }
}

TEST_CASE("a profiler says that its range is below the altitude") {
  AtRest at_rest(60.0);
  const auto health = at_rest.head.step_until<msg::Health>("health", 2500_ms);
  REQUIRE_FALSE(health.empty());
  CHECK(health.back().message == "the range of 50.0 m is below the altitude of 60.0 m");
}

TEST_CASE("a profiler declares one beam, from its down axis") {
  AtRest at_rest(12.0);
  const msg::Value& declaration = at_rest.head.ports().declares().at(msg::HeadDeclaration::kType);
  CHECK(*declaration.at("beam_axis") == msg::Value{std::string("down")});
  CHECK(*declaration.at("finest_beam_rad") == msg::Value{ProfilerConfig{}.beamwidth_rad});
}

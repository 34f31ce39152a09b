#include "components/sidescan/node.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "components/runtime/testing/node_under_test.h"
#include "components/sonar/testing/seabed.h"
#include "messages/motion.h"
#include "messages/navigation.h"

using namespace ensonify;

namespace {

using Head = NodeUnderTest<SidescanNode>;

void give_motion(Head& head, SimTime until) {
  for (SimTime t{0}; t <= until; t += 10_ms) {
    msg::Pose pose;
    pose.stamp_ns = t.count();
    pose.position_enu_m = {0, 2.0 * seconds(t), -2.0};
    pose.enu_from_body = frames::wxyz_of(frames::enu_from_ned());
    head.give("pose", pose);
    msg::Estimate estimate;
    estimate.stamp_ns = t.count();
    estimate.position_enu_m = {5.0, 2.0 * seconds(t), -2.0};
    estimate.enu_from_body = pose.enu_from_body;
    head.give("estimate", estimate);
  }
}

msg::Tile level_tile() {
  return tile_of(256, 2.0, [](double, double) { return -12.0; });
}

/// Two frequencies over 10 m of water, with few rays.
SidescanConfig dual() {
  SidescanConfig config;
  config.quality = 0.1;
  config.channels.resize(2);
  config.channels[0].name = "low";
  config.channels[0].frequency_hz = 100e3;
  config.channels[0].range_m = 60.0;
  config.channels[1].name = "high";
  config.channels[1].range_m = 30.0;
  config.ping_rate_hz = 10.0;
  return config;
}

std::string last_health(Head& head, SimTime t) {
  const auto health = head.step_until<msg::Health>("health", t);
  return health.empty() ? "none" : health.back().state + ": " + health.back().message;
}

}  // namespace

TEST_CASE("both frequencies ping together, each with two sides, its own range and settings") {
  Head head(dual());
  give_motion(head, 500_ms);
  head.give("tile", level_tile());
  const auto low = head.step_until<msg::Ping>("ping_low", 450_ms);
  const auto high = head.step_until<msg::Ping>("ping_high", 450_ms);
  const auto transmissions = head.step_until<msg::Transmit>("transmit", 450_ms);
  REQUIRE(low.size() == 4);
  REQUIRE(high.size() == 4);
  REQUIRE(transmissions.size() == 10);
  CHECK(transmissions[0].frequency_hz == 100e3);
  CHECK(transmissions[1].frequency_hz == 400e3);
  CHECK(low[3].stamp_ns == 300'000'000);
  CHECK(low[3].stamp_ns == high[3].stamp_ns);
  CHECK(low[0].amplitude_upa.rows() == 2);
  CHECK(low[0].applied.range_m == 60.0);
  CHECK(high[0].applied.range_m == 30.0);
  CHECK(low[0].applied.frequency_hz == 100e3);
  CHECK(low[0].beam_angle_rad[0] == Approx(-60 * SidescanChannel::kDegree));
  CHECK(low[0].beam_angle_rad[1] == Approx(60 * SidescanChannel::kDegree));
  // 2 R / c at the instrument's sound speed and the pulse, in samples of half a pulse.
  CHECK(low[0].amplitude_upa.cols() == std::ceil((120.0 / 1500.0 + 100e-6) / 50e-6));
  // The track is the estimate's, 5 m beside the truth.
  CHECK(low[1].track.pose_time_s[0] == 0.0);
  CHECK(low[1].track.pose_position_enu_m(0, 0) == 5.0);
  CHECK(low[1].track.pose_position_enu_m(0, 1) == Approx(0.2));
  const auto bottom = head.step_until<msg::BottomTrack>("bottom_low", 450_ms);
  REQUIRE(bottom.size() == 4);
  CHECK(bottom[3].stamp_ns == low[3].stamp_ns);
}

TEST_CASE("a command changes range, power, pulse, gain and rate from the next ping on") {
  Head head(dual());
  give_motion(head, 1_s);
  head.give("tile", level_tile());
  msg::SonarSettings command;
  command.stamp_ns = 0;    // received at 100 ms
  command.range_m = 40.0;  // more than the high channel has: it takes what it can
  command.source_level_db = 200.0;
  command.pulse_length_s = 200e-6;
  command.gain_offset_db = 6.0;
  command.ping_rate_hz = 5.0;
  head.give("settings", command);
  const auto low = head.step_until<msg::Ping>("ping_low", 900_ms);
  const auto high = head.step_until<msg::Ping>("ping_high", 900_ms);
  REQUIRE(low.size() >= 4);
  CHECK(low[0].applied.range_m == 60.0);
  CHECK(low[0].applied.source_level_db == 215.0);
  CHECK(low[1].stamp_ns == 100'000'000);
  CHECK(low[2].stamp_ns == 300'000'000);  // 5 Hz
  CHECK(low[1].applied.range_m == 40.0);
  CHECK(high[1].applied.range_m == 30.0);
  CHECK(low[1].applied.source_level_db == 200.0);
  CHECK(low[1].applied.pulse_length_s == 200e-6);
  CHECK(low[1].applied.gain_offset_db == 6.0);
  CHECK(low[1].amplitude_upa.cols() == std::ceil((80.0 / 1500.0 + 200e-6) / 50e-6));
}

TEST_CASE("a ping that could only be black says why") {
  Head nowhere(dual());
  give_motion(nowhere, 1_s);
  CHECK(nowhere.step_until<msg::Ping>("ping_low", 1_s).empty());
  CHECK(last_health(nowhere, 2_s) == "degraded: no seabed tile under the head at (0, 2) m");

  auto config = dual();
  config.channels[1].range_m = 8.0;  // 10 m above the bottom
  Head too_high(config);
  give_motion(too_high, 3_s);
  too_high.give("tile", level_tile());
  CHECK(
      last_health(too_high, 2500_ms) ==
      "degraded: no seabed within the range of high (8 m): the range is below the altitude, or the terrain has a hole "
      "here");
}

TEST_CASE("without an estimate pings come without a track, and health says so") {
  Head head(dual());
  for (SimTime t{0}; t <= 1_s; t += 10_ms) {
    msg::Pose pose;
    pose.stamp_ns = t.count();
    pose.position_enu_m = {0, 0, -2.0};
    pose.enu_from_body = frames::wxyz_of(frames::enu_from_ned());
    head.give("pose", pose);
  }
  head.give("tile", level_tile());
  const auto pings = head.step_until<msg::Ping>("ping_low", 500_ms);
  REQUIRE_FALSE(pings.empty());
  CHECK(pings[0].track.pose_time_s.empty());
  CHECK(last_health(head, 1500_ms) == "degraded: no navigation estimate has arrived: pings have no track");
}

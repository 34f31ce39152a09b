#include "components/forward_looking/node.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "components/runtime/testing/node_under_test.h"
#include "components/sonar/testing/config.h"
#include "messages/motion.h"
#include "messages/navigation.h"

using namespace ensonify;

namespace {

using Head = NodeUnderTest<ForwardLookingNode>;

/// A square of seabed at one height about the origin, 128 m wide.
msg::Tile flat_tile(double height_m) {
  msg::Tile tile;
  tile.origin_east_m = tile.origin_north_m = -64.0;
  tile.spacing_m = 0.5;
  tile.height_m = msg::Array<float>({257, 257});
  for (float& h : tile.height_m.flat()) h = static_cast<float>(height_m);
  tile.sediment = msg::Array<std::uint8_t>({257, 257});
  return tile;
}

/// Few beams, samples and rays.
ForwardLookingConfig small() {
  ForwardLookingConfig config;
  config.beams = 32;
  config.beamwidth_rad = 4.0 * ForwardLookingConfig::kDegree;
  config.pulse.most_samples = 200;
  config.quality = 0.1;
  return config;
}

void give_motion(Head& head, double height_m, SimTime until) {
  for (SimTime t{0}; t <= until; t += 10_ms) {
    msg::Pose pose;
    pose.stamp_ns = t.count();
    pose.position_enu_m = {0.0, seconds(t), height_m};
    pose.enu_from_body = frames::wxyz_of(frames::enu_from_ned());
    head.give("pose", pose);
    msg::Estimate estimate;
    estimate.stamp_ns = t.count();
    estimate.position_enu_m = {5.0, seconds(t), height_m};
    estimate.enu_from_body = pose.enu_from_body;
    head.give("estimate", estimate);
  }
}

std::string last_health(Head& head, SimTime t) {
  const auto health = head.step_until<msg::Health>("health", t);
  return health.empty() ? "none" : health.back().state + ": " + health.back().message;
}

/// Of a head at z = height_m over a seabed 15 m below the surface.
std::string health_at(const ForwardLookingConfig& config, double height_m) {
  Head head(config);
  give_motion(head, height_m, 500_ms);
  head.give("tile", flat_tile(-15.0));
  return last_health(head, 450_ms);
}

}  // namespace

TEST_CASE("a ping is an image of beams by samples, with the instrument's estimated poses") {
  Head head(small());
  give_motion(head, -10.0, 500_ms);
  head.give("tile", flat_tile(-15.0));
  const auto transmits = head.step_until<msg::Transmit>("transmit", 440_ms);
  const auto pings = head.step_until<msg::Ping>("ping", 440_ms);
  REQUIRE(transmits.size() == 5);  // 10 Hz
  REQUIRE(pings.size() == 4);      // the fifth is not yet processed
  const msg::Ping& ping = pings[1];
  CHECK(ping.stamp_ns == 100'000'000);
  CHECK(transmits[1].stamp_ns == ping.stamp_ns);
  CHECK(transmits[1].frequency_hz == 750e3);
  REQUIRE(ping.amplitude_upa.rows() == 32);
  REQUIRE(ping.amplitude_upa.cols() == 200);
  CHECK(ping.sample_period_s * 200 == Approx(2 * 20.0 / 1500.0));
  CHECK(ping.beam_angle_rad[0] == Approx(-65 * ForwardLookingConfig::kDegree));
  CHECK(ping.beam_angle_rad[31] == Approx(65 * ForwardLookingConfig::kDegree));
  CHECK(ping.applied.pulse == "fm_up");
  CHECK(ping.applied.range_m == 20.0);
  CHECK(ping.applied.bandwidth_hz == Approx(200 * 1500.0 / 80.0));
  CHECK(ping.applied.sound_speed_mps == 1500.0);
  REQUIRE(ping.track.pose_position_enu_m.rows() > 1);
  CHECK(ping.track.pose_position_enu_m(0, 0) == 5.0);  // the estimate, not the truth
  CHECK(ping.track.pose_position_enu_m(0, 1) == Approx(0.1));
  CHECK(last_health(head, 460_ms) == "ok: ");
}

TEST_CASE("a head that can only see black says why") {
  auto config = small();
  CHECK(health_at(config, -10.0) == "ok: ");
  config.range_m = 5.0;
  config.tilt_rad = 40.0 * ForwardLookingConfig::kDegree;
  CHECK(health_at(config, -5.0) == "degraded: the range of 5.0 m is below the altitude of 10.0 m");
  config.range_m = 20.0;
  config.tilt_rad = -40.0 * ForwardLookingConfig::kDegree;
  CHECK_THAT(health_at(config, -5.0), Catch::StartsWith("degraded: nothing within the range of 20.0 m where the head "
                                                        "points (side lobes hit something): it points over the seabed "
                                                        "10.0 m below"));
  CHECK(health_at(config, 2.0) == "degraded: the head is 2.00 m above the water");
  Head blind(config);
  CHECK(last_health(blind, 150_ms) == "degraded: no pose of the vehicle has arrived");
  Head lost(config);
  give_motion(lost, -5.0, 200_ms);
  CHECK(last_health(lost, 150_ms) == "degraded: no seabed tile under the head at (0, 0) m");
  CHECK(lost.step_until<msg::Ping>("ping", 200_ms).empty());
}

TEST_CASE("on a tide the water is where it stands, not at chart datum") {
  auto config = small();
  config.range_m = 60.0;
  world_of(config).vertical.tide = vertical::Tide(3.0);
  CHECK(health_at(config, 2.0) == "ok: ");
  CHECK(health_at(config, 4.0) == "degraded: the head is 1.00 m above the water");
  world_of(config).vertical.tide = vertical::Tide(-3.0);
  CHECK(health_at(config, -2.0) == "degraded: the head is 1.00 m above the water");
}

TEST_CASE("a command changes range and rate from the next ping on, clamped to the limits") {
  Head head(small());
  give_motion(head, -10.0, 2_s);
  head.give("tile", flat_tile(-15.0));
  msg::SonarSettings wanted;
  wanted.stamp_ns = 0;  // received at 100 ms
  wanted.range_m = 60.0;
  wanted.ping_rate_hz = 5.0;
  wanted.source_level_db = 300.0;
  head.give("settings", wanted);
  const auto pings = head.step_until<msg::Ping>("ping", 1_s);
  REQUIRE(pings.size() > 3);
  CHECK(pings[0].applied.range_m == 20.0);
  CHECK(pings[1].applied.range_m == 60.0);
  CHECK(pings[1].applied.source_level_db == 203.0);
  CHECK(pings[1].sample_period_s * 200 == Approx(2 * 60.0 / 1500.0));
  CHECK(pings[2].stamp_ns - pings[1].stamp_ns == 200'000'000);
}

TEST_CASE("a commanded pulse holds, 0 lets it follow the range again; the swath is fixed") {
  Head head(small());
  give_motion(head, -10.0, 2_s);
  head.give("tile", flat_tile(-15.0));
  const auto command = [&](SimTime at, double pulse_length_s) {
    msg::SonarSettings wanted;
    wanted.stamp_ns = at.count();
    wanted.pulse_length_s = pulse_length_s;
    wanted.swath_rad = 1.0;
    head.give("settings", wanted);
  };
  command(0_s, 2e-3);
  command(300_ms, 0.0);
  command(600_ms, 100e-6);  // at 20 m and 200 samples a chirp has 3.75 kHz: 4 / B is 1.07 ms
  const auto pings = head.step_until<msg::Ping>("ping", 1_s);
  REQUIRE(pings.size() > 8);
  CHECK(pings[0].applied.pulse_length_s == Approx(4 / 3750.0));
  CHECK(pings[1].applied.pulse_length_s == 2e-3);
  CHECK(pings[1].applied.bandwidth_hz == pings[0].applied.bandwidth_hz);
  CHECK(pings[4].applied.pulse_length_s == pings[0].applied.pulse_length_s);
  CHECK(pings[8].applied.pulse_length_s == pings[0].applied.pulse_length_s);
  CHECK(pings[8].applied.swath_rad == pings[0].applied.swath_rad);
}

TEST_CASE("the ping interval obeys 2 R / c plus dead time, always") {
  auto config = small();
  config.range_m = 75.0;  // 0.1 s; a sweep of 1 kHz takes 4 ms
  config.dead_time_s = 0.004;
  Head head(config);
  give_motion(head, -10.0, 1_s);
  head.give("tile", flat_tile(-15.0));
  const auto transmissions = head.step_until<msg::Transmit>("transmit", 900_ms);
  REQUIRE(transmissions.size() > 5);
  for (std::size_t i = 1; i < transmissions.size(); ++i) {
    CHECK(transmissions[i].stamp_ns - transmissions[i - 1].stamp_ns >= 108'000'000);
    CHECK(transmissions[i].stamp_ns - transmissions[i - 1].stamp_ns < 109'000'000);
  }
}

TEST_CASE("the probe's sound speed at the face is applied") {
  Head head(small());
  give_motion(head, -10.0, 300_ms);
  head.give("tile", flat_tile(-15.0));
  msg::SoundSpeed probe;
  probe.stamp_ns = 50'000'000;
  probe.sound_speed_mps = 1478.5;
  head.give("sound_speed", probe);
  const auto pings = head.step_until<msg::Ping>("ping", 240_ms);
  REQUIRE(pings.size() == 2);
  CHECK(pings[0].applied.sound_speed_mps == 1500.0);
  CHECK(pings[1].applied.sound_speed_mps == 1478.5);
}

TEST_CASE("the converter gives counts with the gain in them") {
  auto config = small();
  config.converter = {8, 1e7};
  Head head(config);
  give_motion(head, -10.0, 300_ms);
  head.give("tile", flat_tile(-15.0));
  const auto pings = head.step_until<msg::Ping>("ping", 140_ms);
  REQUIRE(pings.size() == 1);
  CHECK(pings[0].amplitude_upa.empty());
  REQUIRE(pings[0].amplitude_count.rows() == 32);
  CHECK(pings[0].count_upa == Approx(1e7 / 255));
  CHECK(pings[0].applied.gain_spreading_db == 30.0);
  CHECK(*std::max_element(pings[0].amplitude_count.flat().begin(), pings[0].amplitude_count.flat().end()) > 0);
}

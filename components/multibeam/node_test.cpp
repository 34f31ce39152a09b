#include "components/multibeam/node.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "components/multibeam/testing/survey.h"
#include "components/view/ping_view.h"

// When the node pings, what it is given meanwhile, and what it says of itself.

using namespace ensonify;
using Catch::WithinAbs;

namespace {

std::string last_health(Head& head, SimTime t) {
  const auto health = head.step_until<msg::Health>("health", t);
  return health.empty() ? "none" : health.back().state + ": " + health.back().message;
}

std::string bytes_of(const msg::Packet& packet) {
  const msg::Buffer bytes = msg::encode_inline(packet.body);
  return {reinterpret_cast<const char*>(bytes.data), bytes.size};
}

}  // namespace

TEST_CASE("a flat seabed 20 m below answers after 26.7 ms at nadir") {
  Head head(shallow());
  give_motion(head, {}, 200_ms);
  head.give("tile", flat_tile(-20.0));
  const auto pings = head.step_until<msg::Ping>("ping", 150_ms);
  REQUIRE(pings.size() == 1);
  const msg::Ping& ping = pings[0];
  CHECK(ping.stamp_ns == 0);
  REQUIRE(ping.amplitude_upa.rows() == 256);
  const auto nadir = ping.amplitude_upa.row(128);
  const float strongest = *std::max_element(nadir.begin(), nadir.end());
  const auto first = std::find_if(nadir.begin(), nadir.end(), [&](float a) { return a > 0.1F * strongest; });
  const double first_echo_s = ping.first_sample_s + (first - nadir.begin()) * ping.sample_period_s;
  CHECK_THAT(first_echo_s, WithinAbs(2 * 20.0 / 1500.0, 1.5 * ping.sample_period_s));
}

TEST_CASE("without a tile there is no ping, and health says why") {
  Head head(shallow());
  give_motion(head, {}, 1_s);
  CHECK(head.step_until<msg::Ping>("ping", 1_s).empty());
  CHECK(head.step_until<msg::Transmit>("transmit", 1_s).empty());
  CHECK(last_health(head, 2_s) == "degraded: no seabed tile under the head at (0, 0) m");
}

TEST_CASE("a released tile is not pinged on") {
  Head head(shallow());
  give_motion(head, {}, 2_s);
  head.give("tile", flat_tile(-20.0));
  head.run_until(500_ms);
  const auto before = head.step_until<msg::Transmit>("transmit", 500_ms).size();
  CHECK(before == 6);
  head.give_at("release", 550_ms, msg::TileRelease{0, 0});
  CHECK(head.step_until<msg::Transmit>("transmit", 2_s).empty());
}

TEST_CASE("a range below the altitude is said in health") {
  auto config = shallow();
  config.range_m = 15.0;
  Head head(config);
  give_motion(head, {}, 3_s);
  head.give("tile", flat_tile(-20.0));
  CHECK(last_health(head, 2500_ms) == "degraded: the range of 15.0 m is below the altitude of 20.0 m");
}

TEST_CASE("a source level of -200 dB gives no soundings") {
  auto config = shallow();
  config.source_level_db = -200.0;
  const auto soundings = survey(config, {}, 1_s);
  REQUIRE(soundings.size() == 9);
  for (const auto& s : soundings) CHECK(valid_count(s) == 0);
}

TEST_CASE("the ping interval obeys 2 R / c plus dead time, always") {
  auto config = shallow();
  config.range_m = 120.0;
  config.dead_time_s = 0.004;
  Head head(config);
  give_motion(head, {}, 2_s);
  head.give("tile", flat_tile(-20.0));
  const auto transmissions = head.step_until<msg::Transmit>("transmit", 2_s);
  REQUIRE(transmissions.size() > 10);
  const std::int64_t least_ns = from_seconds(2 * 120.0 / 1500.0 + config.pulse_length_s + 0.004).count();
  for (std::size_t i = 1; i < transmissions.size(); ++i)
    CHECK(transmissions[i].stamp_ns - transmissions[i - 1].stamp_ns == least_ns);
}

TEST_CASE("auto range starts at the longest and settles beyond the swath's edge") {
  auto config = shallow();
  config.auto_range = true;
  config.range_m = 200.0;
  Head head(config);
  give_motion(head, {}, 3_s);
  head.give("tile", flat_tile(-20.0));
  const auto pings = head.step_until<msg::Ping>("ping", 3_s);
  REQUIRE(pings.size() > 10);
  CHECK(pings.front().applied.range_m == 200.0);
  const double edge_m = 20.0 / std::cos(65.0 * MultibeamConfig::kDegree);
  CHECK(pings.back().applied.range_m > edge_m * 1.03);
  CHECK(pings.back().applied.range_m < edge_m * 1.2);
  CHECK((pings.back().stamp_ns - pings[pings.size() - 2].stamp_ns) * 1e-9 == Approx(0.1));
}

TEST_CASE("a ping is published at its last echo plus the processing latency") {
  const MultibeamConfig config = shallow();
  Head head(config);
  give_motion(head, {}, 500_ms);
  head.give("tile", flat_tile(-20.0));
  head.run_until(400_ms);
  const auto packets = head.take("soundings");
  REQUIRE_FALSE(packets.empty());
  CHECK(packets[0].envelope.t_sim_ns == from_seconds(2 * 60.0 / 1500.0 + 100e-6).count() + 20'000'000);
}

TEST_CASE("the same ping twice has the same bytes, another seed has others") {
  const auto received = [](std::uint64_t seed) {
    auto config = shallow();
    world_of(config).seed = seed;
    Head head(config);
    give_motion(head, {.speed_mps = 2.0, .roll_rad = 0.1}, 300_ms);
    head.give("tile", flat_tile(-20.0));
    return head.step_until<msg::Ping>("ping", 300_ms);
  };
  const auto a = received(1), b = received(1), other = received(2);
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i].amplitude_upa == b[i].amplitude_upa);
  CHECK_FALSE(a[0].amplitude_upa == other[0].amplitude_upa);
}

TEST_CASE("a viewer sees pings that are not published, and what is published is the same without him") {
  MultibeamConfig config = shallow();
  config.amplitude_every = 1000;
  Head watched(config), alone(config);
  config.amplitude_every = 1;
  Head all(config);
  for (Head* head : {&watched, &alone, &all}) {
    give_motion(*head, {}, 2_s);
    head->give("tile", flat_tile(-20.0));
    head->run_until(150_ms);
  }
  REQUIRE(watched.take("ping").size() == 1);
  REQUIRE(watched.take("view").empty());
  const auto pings = all.step_until<msg::Ping>("ping", 1_s);
  watched.watch();
  alone.run_until(1_s);
  const auto views = watched.step_until<msg::View>("view", 1_s);
  CHECK(watched.take("ping").empty());
  REQUIRE_FALSE(views.empty());
  const auto ping = std::find_if(pings.begin(), pings.end(), [&](const auto& p) { return p.ping == views[0].ping; });
  REQUIRE(ping != pings.end());
  CHECK(ping->ping > 0);
  const msg::View anew = view_of(*ping, "down", {});
  CHECK(views[0].level == anew.level);
  CHECK(views[0].level_floor_db == anew.level_floor_db);
  CHECK(views[0].position_enu_m == anew.position_enu_m);
  CHECK(views[0].find_range_m.size() > 10);
  const auto with = watched.take("soundings"), without = alone.take("soundings");
  REQUIRE(with.size() == without.size());
  REQUIRE(with.size() > 5);
  for (std::size_t i = 0; i < with.size(); ++i) CHECK(bytes_of(with[i]) == bytes_of(without[i]));
}

TEST_CASE("commands change the next ping: range, power, pulse, gain, swath, rate and mode") {
  MultibeamConfig config = shallow();
  config.amplitude_every = 1000;
  Head head(config);
  give_motion(head, {}, 3_s);
  head.give("tile", flat_tile(-20.0));
  msg::SonarSettings wanted;
  wanted.stamp_ns = (1_s).count();
  wanted.range_m = 50.0;
  wanted.source_level_db = 205.0;
  wanted.pulse_length_s = 200e-6;
  wanted.gain_absorption_dbpm = 0.08;
  wanted.swath_rad = 90.0 * MultibeamConfig::kDegree;
  wanted.ping_rate_hz = 5.0;
  wanted.mode = "water_column";
  head.give("settings", wanted);
  const auto pings = head.step_until<msg::Ping>("ping", 3_s);
  const auto soundings = head.step_until<msg::Soundings>("soundings", 3_s);
  REQUIRE(pings.size() > 5);
  CHECK(pings[0].stamp_ns == 0);
  CHECK(pings[0].phase_rad.size() == 0);
  CHECK(pings[1].stamp_ns ==
        (1100_ms).count());  // received 100 ms later, from the next ping on: every one in this mode
  const msg::AppliedSettings& applied = pings[1].applied;
  CHECK(applied.range_m == 50.0);
  CHECK(applied.source_level_db == 205.0);
  CHECK(applied.pulse_length_s == 200e-6);
  CHECK(applied.gain_absorption_dbpm == 0.08);
  CHECK(applied.ping_rate_hz == 5.0);
  CHECK(applied.mode == "water_column");
  CHECK(pings[2].stamp_ns - pings[1].stamp_ns == (200_ms).count());
  CHECK(pings[1].phase_rad.size() == pings[1].amplitude_upa.size());
  CHECK(pings[1].track.pose_time_s.size() > 10);
  CHECK(static_cast<double>(pings[1].beam_angle_rad[255]) == Approx(45.0 * MultibeamConfig::kDegree));
  const double nadir_m = -soundings.back().position_enu_m(128, 2);
  CHECK_THAT(nadir_m, WithinAbs(20.0, 0.05));
}

TEST_CASE("a range of 0 lets the head choose, one beyond the longest is clamped") {
  Head head(shallow());
  give_motion(head, {}, 2_s);
  head.give("tile", flat_tile(-20.0));
  msg::SonarSettings choose, far;
  choose.stamp_ns = (500_ms).count();
  choose.range_m = 0.0;
  far.stamp_ns = (1500_ms).count();
  far.range_m = 500.0;
  head.give("settings", choose, far);
  const auto soundings = head.step_until<msg::Soundings>("soundings", 2_s);
  const auto at = [&](SimTime t) {
    return std::ranges::find(soundings, t.count(), &msg::Soundings::stamp_ns)->applied.range_m;
  };
  CHECK(at(0_ms) == 60.0);
  CHECK_THAT(at(1400_ms), WithinAbs(1.13 * 20.0 / std::cos(65.0 * MultibeamConfig::kDegree), 1.5));
  CHECK(at(1800_ms) == 60.0);
}

TEST_CASE("sectors of several frequencies, one after the other, see one flat seabed") {
  MultibeamConfig config = shallow();
  config.sectors = {
      {.frequency_hz = 280e3, .delay_s = 1e-3}, {.frequency_hz = 300e3, .delay_s = 2e-3}, {.frequency_hz = 320e3}};
  const auto pings = survey(config, {.speed_mps = 3.0}, 1_s);
  CHECK(valid_count(pings.back()) > 250);
  for (const auto& [from, to] : {std::pair{0.0, 15.0}, {15.0, 45.0}, {45.0, 62.0}}) {
    const Spread error = depth_error(pings, from, to);
    INFO(from << " to " << to << " deg: mean " << error.mean << " m, sd " << error.sd << " m of " << error.count);
    CHECK(std::abs(error.mean) < 0.02);
    CHECK(error.sd < 0.04);
  }
}

TEST_CASE("each sector's transmission is published with its time and frequency, in order") {
  MultibeamConfig config = shallow();
  config.sectors = {
      {.frequency_hz = 280e3, .delay_s = 1e-3}, {.frequency_hz = 300e3, .delay_s = 2e-3}, {.frequency_hz = 320e3}};
  Head head(config);
  give_motion(head, {}, 300_ms);
  head.give("tile", flat_tile(-20.0));
  const auto reported = head.step_until<msg::Transmit>("transmit", 250_ms);
  REQUIRE(reported.size() == 9);
  const double frequencies_hz[] = {320e3, 280e3, 300e3};
  for (std::size_t i = 0; i < reported.size(); ++i) {
    const auto ping = static_cast<std::int64_t>(i / 3);
    CHECK(reported[i].ping == ping);
    CHECK(reported[i].frequency_hz == frequencies_hz[i % 3]);
    CHECK(reported[i].stamp_ns == ping * 100'000'000 + static_cast<std::int64_t>(i % 3) * 1'000'000);
  }
}

TEST_CASE("a ping rehearsed before real time starts changes no message") {
  MultibeamConfig config = shallow();
  config.auto_range = true;
  config.range_m = 100.0;
  const auto sent_by = [&](bool paced) {
    Head head(config);
    if (paced) head.pace();
    give_motion(head, {.speed_mps = 2.0, .roll_rad = 0.1, .motion_sensor = true}, 700_ms);
    head.give("tile", flat_tile(-20.0));
    head.run_until(600_ms);
    std::string bytes;
    for (const char* port : {"transmit", "ping", "soundings", "health"})
      for (const msg::Packet& packet : head.take(port)) bytes += bytes_of(packet);
    return bytes;
  };
  const std::string free = sent_by(false);
  CHECK(free.size() > 1'000'000);
  CHECK((sent_by(true) == free));
}

#include <catch2/catch.hpp>

#include "components/config/parameter_info.h"
#include "components/navigation/testing/circle.h"

using namespace ensonify;
using namespace ensonify::test_run;
using Catch::WithinAbs;

// What every instrument does with its outages, its clock and its latency.

namespace {

struct Came {
  SimTime at;
  std::int64_t stamp_ns;
};

template <class Message>
std::int64_t stamp_of(const msg::Packet& packet) {
  return msg::decode<Message>(packet.body, packet.body.size()).stamp_ns;
}

struct Topic {
  std::string section, keys, port;
  std::int64_t (*stamp_ns)(const msg::Packet&);
};

const std::vector<Topic> kTopics{
    {"imu", "rate_hz: 10", "imu", stamp_of<msg::InertialIncrements>},
    {"gnss", "position_m: [0, 0, -3], first_fix_s: 0, converge_s: 0", "position", stamp_of<msg::Position>},
    {"motion_sensor", "rate_hz: 10, delayed_heave_s: 2", "attitude", stamp_of<msg::Attitude>},
    {"motion_sensor", "rate_hz: 10, delayed_heave_s: 2", "delayed_heave", stamp_of<msg::DelayedHeave>},
    {"heading", "rate_hz: 5", "heading", stamp_of<msg::Heading>},
    {"velocity_log", "rate_hz: 5", "velocity_log", stamp_of<msg::VelocityLog>},
    {"depth", "rate_hz: 5", "depth", stamp_of<msg::Depth>},
    {"altimeter", "rate_hz: 5", "altitude", stamp_of<msg::Altitude>},
    {"sound_speed", "rate_hz: 5", "sound_speed", stamp_of<msg::SoundSpeed>},
    {"ctd", "rate_hz: 5", "ctd", stamp_of<msg::Ctd>},
    {"current_profiler", "rate_hz: 5", "current_profile", stamp_of<msg::CurrentProfile>},
    {"usbl", "rate_hz: 5", "usbl", stamp_of<msg::UsblFix>},
};

/// What comes on the topic in ten seconds when `keys` stand in its section too.
std::vector<Came> reported(const Topic& topic, const std::string& keys) {
  constexpr int kSeconds = 10;
  NodeUnderTest<NavigationNode> navigation(config_of(topic.section + ": { " + topic.keys + ", " + keys + " }"));
  if (topic.section == "usbl") {
    for (int i = 0; i <= 100 * kSeconds; ++i) {
      navigation.give("target", circling(i * 10_ms, [](double) { return -30.0; }));
    }
  }
  run_for(navigation, kSeconds, kLevel);
  navigation.run_until(SimTime{std::chrono::seconds(kSeconds)});
  std::vector<Came> came;
  for (const msg::Packet& packet : navigation.take(topic.port)) {
    came.push_back({SimTime{packet.envelope.t_sim_ns}, topic.stamp_ns(packet)});
  }
  return came;
}

void check_same(const std::vector<Came>& came, const std::vector<Came>& expected) {
  REQUIRE(came.size() == expected.size());
  for (std::size_t i = 0; i < came.size(); ++i) {
    REQUIRE(came[i].at == expected[i].at);
    REQUIRE(std::abs(came[i].stamp_ns - expected[i].stamp_ns) <= 1);  // seconds are rounded to nanoseconds
  }
}

/// Those that come by the run's end when each comes, and is stamped, later by so much.
std::vector<Came> later(const std::vector<Came>& all, SimTime comes, SimTime stamped) {
  std::vector<Came> moved;
  for (const Came& came : all) {
    if (came.at + comes <= 10_s) moved.push_back({came.at + comes, came.stamp_ns + stamped.count()});
  }
  return moved;
}

}  // namespace

TEST_CASE("every instrument is silent in outages, stamped by its clock, late by its latency") {
  for (const ParameterInfo& section : parameters_of<Instruments>()) {
    INFO(section.key);
    if (section.key == "usbl_fixes") continue;  // what it receives is another vehicle's
    CHECK(std::any_of(kTopics.begin(), kTopics.end(), [&](const Topic& t) { return t.section == section.key; }));
  }
  for (const Topic& topic : kTopics) {
    INFO(topic.section << ": " << topic.port);
    const std::vector<Came> usual = reported(topic, "latency_s: 0");
    REQUIRE(usual.size() > 20);
    check_same(reported(topic, "clock: { locked: false, offset_s: 5 }"), later(usual, 0_s, 5_s));
    check_same(reported(topic, "latency_s: 1.35, stamped_at: measurement"), later(usual, 1350_ms, 0_s));
    check_same(reported(topic, "latency_s: 1.35, stamped_at: output"), later(usual, 1350_ms, 1350_ms));
    if (topic.section == "imu") continue;  // may not fall out
    std::vector<Came> received;
    for (const Came& came : usual) {
      if (came.at < 6_s || came.at >= 8_s) received.push_back(came);
    }
    REQUIRE(received.size() < usual.size());
    check_same(reported(topic, "outages_s: [6, 8]"), received);
  }
}

TEST_CASE("outages of an inertial unit are refused, with place, cause and what may fail") {
  CHECK_THROWS_WITH(config_of("imu: { grade: fog, outages_s: [100, 160] }"),
                    Catch::Contains("nav.yaml:1:31: imu.outages_s: without its readings there is no estimate, so an "
                                    "inertial unit may not fall out; what aids it may: gnss, velocity_log, depth, "
                                    "heading"));
  CHECK_NOTHROW(config_of("imu: { grade: fog, outages_s: [] }"));
}

TEST_CASE("the inertial unit's latency and clock leave the estimate as it is") {
  const auto last = [](const std::string& keys) {
    NodeUnderTest<NavigationNode> navigation(config_of("imu: { grade: mems, " + keys + " }\ngnss: { grade: dgps }"));
    run_for(navigation, 3, kLevel);
    return navigation.step_until<msg::Estimate>("estimate", 3_s).back();
  };
  const msg::Estimate usual = last("latency_s: 0"), late = last("latency_s: 0.5, clock: { residual_s: 0.2 }");
  CHECK(late.stamp_ns == usual.stamp_ns);
  CHECK(late.position_enu_m == usual.position_enu_m);
}

TEST_CASE("attitude has the newest heading that the compass has sent") {
  NodeUnderTest<NavigationNode> navigation(config_of("heading: { errors: { bias_deg: 2 }, latency_s: 0.5 }"));
  run_for(navigation, 3, kLevel);
  for (const msg::Attitude& attitude : navigation.step_until<msg::Attitude>("attitude", 3_s)) {
    if (attitude.stamp_ns % 100'000'000 != 0 || attitude.stamp_ns < 500'000'000) continue;  // ten headings a second
    const double then_s = 1e-9 * static_cast<double>(attitude.stamp_ns) - 0.5;
    REQUIRE_THAT(attitude.heading_grid_rad, WithinAbs(0.02 * then_s + 2 * kDegree, 1e-5));
  }
}

TEST_CASE("a grade says when its instrument stamps, and the section has the last word") {
  const auto depth = [](const std::string& keys) {
    return config_of("depth: { " + keys + " }").instruments.depth->instrument.stamping;
  };
  CHECK(depth("grade: quartz") == sensors::Stamping::kOutput);
  CHECK(depth("grade: quartz, stamped_at: measurement") == sensors::Stamping::kMeasurement);
  CHECK(depth("rate_hz: 5") == sensors::Stamping::kMeasurement);
  const Instruments carried = config_of("gnss: { grade: rtk }\nheading: { grade: satellite }").instruments;
  CHECK(carried.gnss->instrument.stamping == sensors::Stamping::kMeasurement);
  CHECK(carried.heading->instrument.stamping == sensors::Stamping::kMeasurement);
}

#include <catch2/catch.hpp>
#include <cmath>

#include "components/config/config_reader.h"
#include "components/runtime/testing/node_under_test.h"
#include "components/sidescan/node.h"
#include "components/sonar/testing/seabed.h"
#include "messages/motion.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

using Head = NodeUnderTest<SidescanNode>;

constexpr double kLever_m = 2.0;  // to the other head, abeam to starboard
constexpr double kAltitude_m = 10.0;
constexpr double kPulse_s = 100e-6;

/// 10 pings a second over a level bottom, 30 m far, with few rays and nothing in the water but another head's sound.
SidescanConfig beside_another() {
  SidescanConfig config;
  config.quality = 0.1;
  config.channels[0].range_m = 30.0;
  config.channels[0].pulse_length_s = kPulse_s;
  config.ping_rate_hz = 10.0;
  config.effects.noise = config.effects.volume = config.effects.multipath = config.effects.absorption = false;
  OtherHead other;
  other.process = "bow";
  other.isolation_db = 60.0;
  other.bottom_loss_db = 30.0;
  other.from_us_body_m = {0.0, kLever_m, 0.0};
  config.interference = {other};
  return config;
}

msg::Transmit transmission_of_other(SimTime at) {
  msg::Transmit transmit;
  transmit.stamp_ns = at.count();
  transmit.frequency_hz = 400e3;
  transmit.pulse_length_s = kPulse_s;
  transmit.source_level_db = 220.0;
  return transmit;
}

void give_surroundings(Head& head, SimTime until) {
  for (SimTime t{0}; t <= until; t += 10_ms) {
    msg::Pose pose;
    pose.stamp_ns = t.count();
    pose.position_enu_m = {0, 2.0 * seconds(t), -2.0};
    pose.enu_from_body = frames::wxyz_of(frames::enu_from_ned());
    head.give("pose", pose);
  }
  head.give("tile", tile_of(256, 2.0, [](double, double) { return -2.0 - kAltitude_m; }));
}

/// What is received of `others`, ping by ping.
std::vector<msg::Ping> receive_echoes(const SidescanConfig& config, const std::vector<msg::Transmit>& others,
                                      SimTime until) {
  Head head(config);
  give_surroundings(head, until);
  for (const auto& other : others) head.give("bow/transmit", other);
  return head.step_until<msg::Ping>("ping_main", until);
}

/// Time of the first sound of a side (0 port, 1 starboard), to a sample.
double first_arrival_s(const msg::Ping& ping, std::size_t side) {
  std::size_t k = 0;
  while (k < ping.amplitude_upa.cols() && ping.amplitude_upa(side, k) == 0.0F) ++k;
  return ping.first_sample_s + static_cast<double>(k) * ping.sample_period_s;
}

double slant_range_m(double time_s) { return 0.5 * 1500.0 * time_s; }

/// Sound in the water of a scenario that states neither profile nor temperature.
double flight_s(const SidescanConfig& config, double path_m) {
  return path_m / true_profile(*config.world).speed_mps(2.0);
}

}  // namespace

TEST_CASE("interference is at its slant range, and drifts where heads are not synchronised") {
  const auto config = beside_another();
  std::vector<msg::Transmit> others;  // every 101 ms, from 3 ms after our first
  for (int n = 0; n < 6; ++n) others.push_back(transmission_of_other(3_ms + n * 101_ms));
  const auto pings = receive_echoes(config, others, 600_ms);
  REQUIRE(pings.size() >= 5);
  for (int n = 0; n < 5; ++n) {
    const double expected_s = 3e-3 + n * 1e-3 + flight_s(config, kLever_m);
    CHECK_THAT(first_arrival_s(pings[n], 1), WithinAbs(expected_s, pings[n].sample_period_s));
  }
  const double drift_m = slant_range_m(first_arrival_s(pings[4], 1)) - slant_range_m(first_arrival_s(pings[0], 1));
  CHECK_THAT(drift_m, WithinAbs(4 * 0.75, slant_range_m(pings[0].sample_period_s)));
}

TEST_CASE("cross-talk has the level of source, isolation, spreading and our own pattern") {
  const auto config = beside_another();
  const auto pings = receive_echoes(config, {transmission_of_other(3_ms)}, 150_ms);
  const double expected_s = 3e-3 + flight_s(config, kLever_m);
  const auto sides = side_patterns(config, config.channels[0]);
  const auto sample = static_cast<std::size_t>((expected_s + 0.5 * kPulse_s) / pings[0].sample_period_s);
  for (const std::size_t side : {0U, 1U}) {
    const double pattern_db = 20 * std::log10(std::abs(sides.receive[side].amplitude(Eigen::Vector3f::UnitY(), 1e6F)));
    CHECK_THAT(20 * std::log10(pings[0].amplitude_upa(side, sample)),
               WithinAbs(220 - 60 - 20 * std::log10(kLever_m) + pattern_db, 0.01));
  }
}

TEST_CASE("it comes by way of the bottom too, where the mirror is") {
  const auto config = beside_another();
  // Sent 5 ms before our ping: the straight sound is over; down and up take 13.5 ms, before our own first bottom.
  const auto pings = receive_echoes(config, {transmission_of_other(95_ms)}, 250_ms);
  REQUIRE(pings.size() == 2);
  const double expected_s = -5e-3 + flight_s(config, std::hypot(2.0 * kAltitude_m, kLever_m));
  CHECK_THAT(first_arrival_s(pings[1], 1), WithinAbs(expected_s, pings[1].sample_period_s));
  CHECK(first_arrival_s(pings[0], 1) > 2.0 * kAltitude_m / 1550.0);  // sent after its 40 ms: not received
}

TEST_CASE("a slave receives its master at one range only") {
  auto config = beside_another();
  config.trigger.mode = Trigger::Mode::kSlave;
  config.trigger.offset_s = 0.0;
  Head head(config);
  give_surroundings(head, 1_s);
  for (int n = 0; n < 9; ++n) {
    auto master = transmission_of_other(n * 103_ms);
    master.ping = n;
    master.next_ns = ((n + 1) * 103_ms).count();
    head.give("trigger", master);
    head.give("bow/transmit", master);
  }
  const auto pings = head.step_until<msg::Ping>("ping_main", 1_s);
  REQUIRE(pings.size() == 9);
  for (int n = 0; n < 9; ++n) {
    CHECK(pings[n].stamp_ns == (n * 103_ms).count());
    CHECK(first_arrival_s(pings[n], 1) == first_arrival_s(pings[0], 1));
  }
  CHECK_THAT(slant_range_m(first_arrival_s(pings[0], 1)), WithinAbs(0.5 * kLever_m, 0.1));
}

TEST_CASE("interference switched off changes nothing but itself") {
  auto config = beside_another();
  config.effects.noise = config.effects.volume = true;
  const std::vector<msg::Transmit> others{transmission_of_other(3_ms)};
  const auto with = receive_echoes(config, others, 150_ms);
  config.effects.interference = false;
  const auto without = receive_echoes(config, others, 150_ms);
  config.interference.clear();
  Head alone(config);
  give_surroundings(alone, 150_ms);
  const auto never = alone.step_until<msg::Ping>("ping_main", 150_ms);
  const double from_s = 3e-3 + flight_s(config, kLever_m), to_s = from_s + kPulse_s;
  const double bounce_s = 3e-3 + flight_s(config, std::hypot(2.0 * kAltitude_m, kLever_m));
  for (std::size_t k = 0; k < with[0].amplitude_upa.cols(); ++k) {
    REQUIRE(without[0].amplitude_upa(1, k) == never[0].amplitude_upa(1, k));
    const double t = static_cast<double>(k) * with[0].sample_period_s;
    const bool received = (t >= from_s && t < to_s) || (t >= bounce_s && t < bounce_s + kPulse_s);
    INFO(t);
    REQUIRE((with[0].amplitude_upa(1, k) != without[0].amplitude_upa(1, k)) == received);
  }
}

TEST_CASE("interfering heads are of the same vehicle, and need time to arrive") {
  World world;
  Vehicle boat;
  boat.name = "boat";
  boat.mountings["side"].actual.position_body_m = {1.0, 0.0, 0.5};
  boat.mountings["bow"].actual.position_body_m = {3.0, -1.0, 0.5};
  Vehicle other;
  other.name = "auv";
  other.mountings["far"] = {};
  world.vehicles = {boat, other};
  const auto read = [&](const std::string& yaml, std::string& problems) {
    auto from = ConfigReader::from_text(yaml, "head.yaml");
    auto config = SidescanConfig::read(from, world, "side");
    try {
      from.finish();
    } catch (const ConfigError& error) {
      problems = error.what();
    }
    return config;
  };
  std::string problems;
  const auto config = read("{interference: {bow: {isolation_db: 50}}}", problems);
  CHECK(problems == "");
  REQUIRE(config.interference.size() == 1);
  CHECK(config.interference[0].isolation_db == 50.0);
  CHECK(config.interference[0].from_us_body_m == frames::Vec3(2.0, -1.0, 0.0));
  read("{interference: {far: {}}}", problems);
  CHECK_THAT(problems, Catch::Contains("interference.far: the vehicle of side carries no other head of this "
                                       "name; it carries: bow"));
  read("{processing_latency_s: 0, interference: {bow: {}}}", problems);
  CHECK_THAT(problems, Catch::Contains("at least 0.001 is needed"));
}

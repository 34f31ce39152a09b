#include <catch2/catch.hpp>

#include "components/config/read_parameters.h"
#include "components/sonar/auto_range.h"
#include "components/sonar/ping_cycle.h"

using namespace ensonify;

namespace {

Trigger slave(double offset_s) { return {.mode = Trigger::Mode::kSlave, .offset_s = offset_s}; }

/// A clock of a head that always can, driven as a node drives it.
class Driven {
 public:
  explicit Driven(const Trigger& trigger, Rate rate = {10, 1})
      : ports_("head"), clock_(ports_, {.rate = rate, .dead_time = 1_ms, .trigger = trigger}) {
    ports_.seal();
    ports_.connect({}, {}, [this](std::size_t, msg::Body body, const msg::Buffer&) {
      health_ = msg::decode<msg::Health>(body, body.size());
    });
  }

  /// Runs until `t`; what the master has sent is given when it is due.
  void run(SimTime t, SimTime reception) {
    while (clock_.next() <= t) {
      const SimTime now = clock_.next();
      ports_.begin_event(now);
      for (; !masters_.empty() && masters_.front().second <= now; masters_.pop_front()) {
        ports_.deliver(0, packet(masters_.front().first));
      }
      if (clock_.due(now)) {
        sent_.push_back(now);
        clock_.transmitted(now, reception);
      }
      REQUIRE(clock_.next() > now);
      ports_.end_event();
    }
  }

  /// The master transmits, says when it means to do so next, and is received `late` after it.
  void master(SimTime at, SimTime next = 0_ms, SimTime late = 0_ms) {
    msg::Transmit transmit;
    transmit.stamp_ns = at.count();
    transmit.ping = masters_reported_++;
    transmit.next_ns = next.count();
    masters_.emplace_back(transmit, at + late);
  }
  /// A further sector of its last ping: received with the first.
  void sector_of_master(SimTime after) {
    auto [transmit, received] = masters_.back();
    transmit.stamp_ns += after.count();
    masters_.emplace_back(transmit, received);
  }

  PingClock& clock() { return clock_; }
  const std::vector<SimTime>& sent() const { return sent_; }
  /// As last published: at most once a second.
  const msg::Health& health() const { return health_; }
  std::int64_t counted(const std::string& what) const {
    for (const auto& counter : health_.counters) {
      if (counter.name == what) return counter.count;
    }
    return 0;
  }

 private:
  static msg::Packet packet(const msg::Transmit& transmit) {
    msg::Packet packet;
    packet.body = msg::encode(transmit);
    return packet;
  }

  Ports ports_;
  PingClock clock_;
  std::deque<std::pair<msg::Transmit, SimTime>> masters_;
  std::int64_t masters_reported_ = 0;
  std::vector<SimTime> sent_;
  msg::Health health_;
};

using Times = std::vector<SimTime>;

}  // namespace

TEST_CASE("short pings keep the beat exactly") {
  Driven head({}, {15, 1});
  head.run(60_s, 50_ms);
  REQUIRE(head.sent().size() == 901);
  for (int n = 0; n < 900; ++n) REQUIRE(head.sent()[n] == event_time(n, {15, 1}));
}

TEST_CASE("a long ping moves the beat: never less than reception plus dead time") {
  Ports ports("head");
  PingClock clock(ports, {.rate = {10, 1}, .dead_time = 1_ms});
  clock.transmitted(0_ms, 120_ms);
  CHECK(clock.next() == 121_ms);
  clock.transmitted(121_ms, 50_ms);
  CHECK(clock.next() == 221_ms);
  clock.transmitted(221_ms, 99_ms);
  CHECK(clock.next() == 321_ms);
  clock.transmitted(321_ms, 100_ms);
  CHECK(clock.next() == 422_ms);
  clock.skipped();
  CHECK(clock.next() == 522_ms);
  clock.set_rate({20, 1});
  clock.transmitted(522_ms, 10_ms);
  CHECK(clock.next() == 572_ms);
  CHECK(clock.intended() == 572_ms);
}

TEST_CASE("a slave transmits a fixed time after its master, to the nanosecond") {
  for (const double offset_s : {0.0, 0.003, 0.05, 0.25}) {  // also longer than the master's interval
    Driven head(slave(offset_s));
    Times wanted;
    for (int n = 0; n < 40; ++n) {
      head.master(event_time(n, {7, 1}), event_time(n + 1, {7, 1}));
      wanted.push_back(event_time(n, {7, 1}) + from_seconds(offset_s));
    }
    head.run(wanted.back(), 20_ms);
    CHECK(head.sent() == wanted);
  }
}

TEST_CASE("a slave follows a ping once, however many sectors it has") {
  Driven head(slave(0.01));
  Times wanted;
  for (int n = 0; n < 10; ++n) {
    head.master(n * 100_ms, (n + 1) * 100_ms);
    head.sector_of_master(1_ms);
    head.sector_of_master(2_ms);
    wanted.push_back(n * 100_ms + 10_ms);
  }
  head.run(wanted.back(), 5_ms);
  CHECK(head.sent() == wanted);
  CHECK(head.counted("triggers_missed") == 0);
}

TEST_CASE("a master without announced times is followed exactly at a sufficient offset") {
  Driven head(slave(0.01));
  for (int n = 0; n < 20; ++n) head.master(event_time(n, {7, 1}));
  head.run(3_s, 20_ms);
  REQUIRE(head.sent().size() == 20);
  for (int n = 0; n < 20; ++n) CHECK(head.sent()[n] == event_time(n, {7, 1}) + 10_ms);
}

TEST_CASE("a slave that still receives skips the master's transmission, and counts it") {
  Driven head(slave(0.0));
  for (int n = 0; n < 20; ++n) head.master(n * 100_ms, (n + 1) * 100_ms);
  head.run(1950_ms, 150_ms);
  REQUIRE(head.sent().size() == 10);  // every other one
  CHECK(head.sent()[1] == 200_ms);
  head.run(3100_ms, 150_ms);
  CHECK(head.counted("triggers_missed") == 10);
}

TEST_CASE("a slave keeps its own highest ping rate; rounding to nanoseconds is not faster") {
  Driven at_rate(slave(0.0), {15, 1}), faster(slave(0.0), {15, 1});
  for (int n = 0; n < 30; ++n) {
    at_rate.master(event_time(n, {15, 1}), event_time(n + 1, {15, 1}));
    faster.master(event_time(n, {30, 1}), event_time(n + 1, {30, 1}));
  }
  at_rate.run(2_s, 10_ms);
  faster.run(1_s, 10_ms);
  CHECK(at_rate.sent().size() == 30);
  CHECK(faster.sent().size() == 15);
}

TEST_CASE("a late master is followed at once and counted; a missing one shows in health") {
  Driven head(slave(0.0));
  head.master(0_ms, 100_ms);
  head.master(100_ms, 0_ms, 4_ms);  // the poll at 100 ms comes too early for it, the next is 10 ms later
  head.run(500_ms, 20_ms);
  CHECK(head.sent() == Times{0_ms, 110_ms});
  head.run(1100_ms, 20_ms);
  CHECK(head.counted("triggers_late") == 1);
  CHECK(head.health().state != "degraded");
  head.run(3200_ms, 20_ms);
  CHECK(head.health().state == "degraded");
  CHECK(head.health().message == "the master has not transmitted since 0.100 s");

  Driven lonely(slave(0.0));
  lonely.run(2100_ms, 20_ms);
  CHECK(lonely.health().message == "this head is a slave, and its master has not transmitted");
}

TEST_CASE("interleaved heads transmit in slots; a long ping skips slots, keeps the beat") {
  const Trigger trigger{.mode = Trigger::Mode::kInterleaved, .cycle_s = 0.15, .slot_s = 0.05};
  Driven head(trigger);
  head.run(400_ms, 60_ms);
  CHECK(head.sent() == Times{50_ms, 200_ms, 350_ms});
  head.run(1_s, 200_ms);  // what was sent at 350 ms received 60 ms
  CHECK(head.sent() == Times{50_ms, 200_ms, 350_ms, 500_ms, 800_ms});
  CHECK(head.clock().intended() == 1100_ms);
}

TEST_CASE("a trigger is read with its limits") {
  const auto problems = [](const std::string& yaml) {
    auto from = ConfigReader::from_text(yaml, "head.yaml");
    Trigger trigger;
    if (auto section = from.optional_section("trigger")) read_parameters(*section, trigger);
    try {
      from.finish();
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(problems("{trigger: {mode: slave, offset_s: 0.05}}") == "");
  CHECK(problems("{trigger: {mode: interleaved, cycle_s: 0.2, slot_s: 0.2}}") ==
        "head.yaml:1:53: trigger.slot_s: 0.2 s does not lie in the cycle of 0.2 s");
  CHECK_THAT(problems("{trigger: {mode: master}}"), Catch::Contains("free, slave, interleaved"));
}

TEST_CASE("auto range follows the edge of the swath and falls back to the longest") {
  AutoRange range(200, 1.1, 256);
  CHECK(range.range_m() == 200);
  std::vector<BottomDetection> level;  // 20 m below
  for (int beam = 0; beam < 256; ++beam) {
    const double angle = -1.1 + 2.2 * beam / 255;
    level.push_back({angle, 20.0 / std::cos(angle)});
  }
  const double edge_m = 20.0 / std::cos(1.1);
  const auto settled = [&](std::vector<BottomDetection> received, double received_range_m) {
    range.update(received, received_range_m);
    return range.range_m();
  };
  CHECK(settled(level, 200) == std::ceil(1.13 * edge_m));
  auto outlier = level;
  outlier[100].range_m = 190;
  CHECK(settled(outlier, 200) == std::ceil(1.13 * edge_m));
  // The outer beams of one side are lost: what the others say of the edge still holds.
  CHECK(settled({level.begin() + 20, level.end()}, 45) == std::ceil(1.13 * edge_m));
  CHECK(settled({level.begin() + 20, level.end() - 20}, 45) == std::ceil(1.13 * edge_m));
  // Half of them are lost, as after a step down: receive longer.
  CHECK(settled({level.begin() + 70, level.end() - 70}, 60) == 66);
  CHECK(settled({level.begin(), level.begin() + 10}, 60) == 200);
}

#include "tools/console/alarms.h"

#include <catch2/catch.hpp>

#include "messages/clock.h"
#include "messages/health.h"
#include "messages/motion.h"
#include "messages/soundings.h"

using namespace ensonify;
using namespace ensonify::console;

namespace {

/// Messages to alarms, numbered as they come.
struct Watch {
  Alarms alarms = Alarms();
  std::map<std::string, std::uint64_t> seq = {};

  template <msg::Message M>
  void give(const std::string& topic, const M& message) {
    msg::Packet packet{topic, {}, msg::encode(message), {}};
    packet.envelope.seq = seq[topic]++;
    packet.envelope.t_sim_ns = message.stamp_ns;
    alarms.take(M::kType, packet);
  }
  void ping(int valid) {
    msg::Soundings soundings;
    soundings.valid = msg::Array<std::uint8_t>::of({0, static_cast<std::uint8_t>(valid)});
    give("bow/soundings", soundings);
  }
  void on_line(double cross_track_m, const char* state = "on_line") {
    msg::MissionState mission;
    mission.state = state;
    mission.cross_track_m = cross_track_m;
    give("pilot/mission", mission);
  }
  msg::ConsoleAlarm of(const std::string& kind, const std::string& source = "") {
    for (const auto& alarm : alarms.message().alarms)
      if (alarm.kind == kind && (source.empty() || alarm.source == source)) return alarm;
    return {};
  }
};

}  // namespace

TEST_CASE("limits of alarms are those that were asked for, also after it begins anew") {
  AlarmLimits limits;
  limits.pings_without_bottom = 2;
  limits.off_line_m = 5.0;
  Watch watch{Alarms(limits), {}};
  for (int round = 0; round < 2; ++round) {
    watch.on_line(5.0);
    watch.ping(0);
    CHECK_FALSE(watch.of("off_line").active);
    CHECK_FALSE(watch.of("no_bottom").active);
    watch.on_line(-5.1);
    watch.ping(0);
    CHECK(watch.of("off_line").active);
    CHECK(watch.of("no_bottom").active);
    watch.on_line(4.1);  // not well on it
    CHECK(watch.of("off_line").active);
    watch.on_line(3.9);
    CHECK_FALSE(watch.of("off_line").active);
    watch.alarms.clear();
  }
}

TEST_CASE("five pings in a row without a bottom raise an alarm, one with a bottom ends it") {
  Watch watch;
  for (int i = 0; i < 4; ++i) watch.ping(0);
  watch.ping(1);
  for (int i = 0; i < 4; ++i) watch.ping(0);
  CHECK_FALSE(watch.alarms.changed());
  watch.ping(0);
  CHECK(watch.alarms.changed());
  CHECK(watch.of("no_bottom").active);
  CHECK(watch.of("no_bottom").source == "bow/soundings");
  CHECK(watch.of("no_bottom").raised == 1);
  watch.ping(1);
  CHECK_FALSE(watch.of("no_bottom").active);
  for (int i = 0; i < 9; ++i) watch.ping(0);
  CHECK(watch.of("no_bottom").raised == 2);
  CHECK(watch.of("no_bottom").text == "no bottom in the last 9 pings");
}

TEST_CASE("off the line is far from it while on it") {
  Watch watch;
  watch.on_line(50.0, "turn");
  watch.on_line(9.9);
  CHECK(watch.of("off_line").raised == 0);
  watch.on_line(-10.5);
  CHECK(watch.of("off_line").active);
  CHECK(watch.of("off_line").text == "10.5 m to port of the runline");
  watch.on_line(-9.0);
  CHECK(watch.of("off_line").active);  // neither here nor there
  watch.on_line(-7.0);
  CHECK_FALSE(watch.of("off_line").active);
}

TEST_CASE("a process that is degraded or failed says why") {
  Watch watch;
  msg::Health health;
  health.stamp_ns = 7;
  health.state = "degraded";
  health.message = "no navigation estimate has arrived";
  watch.give("bow/health", health);
  CHECK(watch.of("degraded").source == "bow");
  CHECK(watch.of("degraded").text == health.message);
  CHECK(watch.of("degraded").since_ns == 7);
  health.state = "failed";
  watch.give("bow/health", health);
  CHECK_FALSE(watch.of("degraded").active);
  CHECK(watch.of("failed").active);
}

TEST_CASE("late pings are counted by the processes, each new one raises the alarm again") {
  Watch watch;
  msg::Health health;
  health.counters = {{"pings", 50}, {"pings_skipped", 0}};
  watch.give("bow/health", health);
  CHECK(watch.of("late_pings").raised == 0);
  for (const int skipped : {1, 1, 3}) {
    health.counters[1].count = skipped;
    watch.give("bow/health", health);
  }
  CHECK(watch.of("late_pings").raised == 2);
  CHECK(watch.of("late_pings").text == "3 pings were late or left out");
  CHECK_FALSE(watch.of("late_pings").active);
}

TEST_CASE("a run behind its pace, slips, and a process that is late") {
  Watch watch;
  msg::ClockHealth clock;
  clock.rate = 1.0;
  clock.slips = 4;  // from before anybody watched
  clock.participants = {{"bow", 10, 1.0, 3, 0.2}};
  watch.give("clock/health", clock);
  CHECK(watch.alarms.message().alarms.empty());
  clock.lateness_s = 1.5;
  clock.slips = 5;
  clock.slip_s = 2.0;
  clock.participants[0].worst_lateness_s = 0.4;
  watch.give("clock/health", clock);
  CHECK(watch.of("late", "clock").active);
  CHECK(watch.of("slips").text == "5 slips, 2.0 s of lost time given up");
  CHECK(watch.of("late", "bow").raised == 1);
  CHECK_FALSE(watch.of("late", "bow").active);
  clock.lateness_s = 0.1;
  watch.give("clock/health", clock);
  CHECK_FALSE(watch.of("late", "clock").active);
  CHECK(watch.of("slips").raised == 1);
  CHECK(watch.of("late", "bow").raised == 1);
}

TEST_CASE("messages that did not come are lost, but not while nobody watched the topic") {
  Watch watch;
  watch.ping(1);
  watch.seq["bow/soundings"] += 3;
  watch.ping(1);
  CHECK(watch.of("lost").text == "3 messages did not reach this console");
  watch.alarms.keep({});
  watch.seq["bow/soundings"] += 100;
  watch.ping(1);
  CHECK(watch.of("lost").raised == 1);
}

TEST_CASE("a disk that is nearly full") {
  Alarms alarms;
  alarms.disk("/out", 5'000'000'000);
  CHECK_FALSE(alarms.changed());
  alarms.disk("/out", 12'000'000);
  REQUIRE(alarms.message().alarms.size() == 1);
  CHECK(alarms.message().alarms[0].text == "12 MB left");
  CHECK(alarms.message().alarms[0].active);
}

TEST_CASE("alarms have a bound, and another run begins without any") {
  Watch watch;
  msg::Health health;
  health.state = "degraded";
  for (int i = 0; i < 100; ++i) watch.give("p" + std::to_string(i) + "/health", health);
  CHECK(watch.alarms.message().alarms.size() == Alarms::kMostAlarms);
  watch.alarms.clear();
  CHECK(watch.alarms.message().alarms.empty());
  CHECK(watch.alarms.message().generation == 2);
}

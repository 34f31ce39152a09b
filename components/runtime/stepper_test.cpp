#include "components/runtime/stepper.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "components/errors/assert.h"
#include "components/runtime/peer.h"
#include "components/runtime/testing/node_under_test.h"
#include "messages/health.h"
#include "messages/motion.h"

using namespace ensonify;

namespace {

msg::Guidance command_at(SimTime t, double speed_mps) { return {t.count(), 0.0, speed_mps}; }

/// Notes what it was given at each event, steps at 10 Hz, repeats the last speed on its output.
struct Listener {
  struct Config {
    SimTime delay{0};
  };
  Listener(const Config& config, Ports& ports)
      : ports_(ports), echo(ports.out<msg::Guidance>("echo", {.rate = {10, 1}})), events({10, 1}) {
    ports.in<msg::Guidance>("command",
                            [this](const msg::Guidance& g) { received.emplace_back(ports_.now(), g.speed_mps); },
                            {.delay = config.delay});
    ports.in_any("all", {"*"},
                 [this](const msg::Packet& p) { order.push_back(p.topic + "#" + std::to_string(p.envelope.seq)); });
    ports.may_finish();
  }
  SimTime step(SimTime now) {
    events.due(now);
    if (!received.empty()) echo.send(command_at(now, received.back().second));
    if (now == finish_at) ports_.finish();
    return events.next();
  }
  Ports& ports_;
  Ports::Out<msg::Guidance> echo;
  Periodic events;
  SimTime finish_at{-1};
  std::vector<std::pair<SimTime, double>> received;
  std::vector<std::string> order;
};

}  // namespace

TEST_CASE("an event receives exactly the messages stamped up to its time, never later ones") {
  NodeUnderTest<Listener> listener({});
  listener.give("command", command_at(0_s, 1.0), command_at(100_ms, 2.0), command_at(101_ms, 3.0));
  listener.run_until(100_ms);
  CHECK(listener.node().received == std::vector<std::pair<SimTime, double>>{{0_s, 1.0}, {100_ms, 2.0}});
  listener.run_until(200_ms);
  CHECK(listener.node().received.back() == std::pair<SimTime, double>{200_ms, 3.0});
}

TEST_CASE("a delayed input receives at the first event at or after stamp plus delay") {
  NodeUnderTest<Listener> listener({.delay = 100_ms});
  listener.give("command", command_at(0_s, 1.0), command_at(50_ms, 2.0));
  listener.run_until(300_ms);
  CHECK(listener.node().received == std::vector<std::pair<SimTime, double>>{{100_ms, 1.0}, {200_ms, 2.0}});
}

TEST_CASE("messages of several topics come by time, then publisher, then topic, then seq") {
  NodeUnderTest<Listener> listener({});
  listener.connect_any("all", "b/y", "guidance/1");
  listener.connect_any("all", "c/x", "guidance/1");
  listener.give("c/x", command_at(0_s, 0.0), command_at(5_ms, 0.0), command_at(5_ms, 0.0));
  listener.give("b/y", command_at(0_s, 0.0), command_at(3_ms, 0.0), command_at(5_ms, 0.0));
  listener.run_until(100_ms);
  CHECK(listener.node().order == std::vector<std::string>{"b/y#0", "c/x#0", "b/y#1", "b/y#2", "c/x#1", "c/x#2"});
}

TEST_CASE("a gap in a topic's sequence is data that its publisher lost") {
  NodeUnderTest<Listener> listener({});
  msg::Packet packet;
  packet.envelope.seq = 1;  // the first must be 0
  Ports ports("p");
  Stepper stepper(ports, [](SimTime) { return kNever; });
  stepper.wire({{0, "a/b", 0, "guidance/1", "a", 0, SimTime{0}, 0}}, {}, {}, 1, 0, [](msg::Packet&&) {});
  CHECK_THROWS_AS(stepper.insert(packet), PeerError);
  CHECK_THROWS_WITH(stepper.insert(packet), "a lost messages: a/b: seq 0 is missing, 1 came");
}

TEST_CASE("a topic of a publisher that may be lost ends where it cannot be used, and the event that notices says so") {
  Ports ports("p");
  std::vector<std::uint64_t> seen;
  ports.in_any("all", {"*"}, [&](const msg::Packet& packet) { seen.push_back(packet.envelope.seq); });
  ports.seal();
  Stepper stepper(ports, [](SimTime now) { return now + 100_ms; });
  Feed feed{0, "a/b", 0, "guidance/1", "a", 0, 50_ms, 0};
  feed.may_be_lost = true;
  stepper.wire({feed}, {}, {}, 1, 0, [](msg::Packet&&) {});
  const auto insert = [&](std::uint64_t seq, SimTime t) {
    msg::Packet packet;
    packet.envelope.seq = seq;
    packet.envelope.t_sim_ns = t.count();
    stepper.insert(packet);
  };
  insert(0, 0_s);
  stepper.close(0, 100_ms, broken_message("a", "a/b", 2, "what"));  // known before the message before it is counted
  stepper.run_to(100_ms);
  insert(1, 100_ms);
  CHECK(stepper.take_unusable().empty());
  stepper.run_to(1_s);
  insert(2, 200_ms);  // of no use any more
  stepper.run_to(2_s);
  CHECK(seen == std::vector<std::uint64_t>{0, 1});
  const auto unusable = stepper.take_unusable();
  REQUIRE(unusable.size() == 1);
  CHECK(unusable[0].event == 200_ms);
  CHECK(unusable[0].why.culprit == "a");
  CHECK(stepper.take_unusable().empty());
}

TEST_CASE("a node that asks for the end stops there, whatever the horizon") {
  NodeUnderTest<Listener> listener({});
  listener.node().finish_at = 200_ms;
  listener.run_until(5_s);
  CHECK(listener.finished());
  CHECK(listener.ports().now() == 200_ms);
}

TEST_CASE("published messages carry the event's time and count up per topic") {
  NodeUnderTest<Listener> listener({});
  listener.give("command", command_at(0_s, 4.0));
  listener.run_until(200_ms);
  const auto packets = listener.take("echo");
  REQUIRE(packets.size() == 3);
  CHECK(packets[2].envelope.seq == 2);
  CHECK(packets[2].envelope.t_sim_ns == 200'000'000);
  CHECK(packets[2].envelope.type_hash == msg::type_hash("guidance/1"));
}

namespace {
struct Stuck {
  struct Config {};
  Stuck(const Config&, Ports&) {}
  SimTime step(SimTime now) { return now; }
};
struct TooBig {
  struct Config {};
  TooBig(const Config&, Ports& ports) : out(ports.out<msg::Guidance>("out", {.max_bytes = 4})) {}
  SimTime step(SimTime) {
    out.send({});
    return kNever;
  }
  Ports::Out<msg::Guidance> out;
};
}  // namespace

namespace {
struct TooOften {
  struct Config {};
  TooOften(const Config&, Ports& ports) : out(ports.out<msg::Guidance>("out", {.rate = {10, 1}})) {}
  SimTime step(SimTime now) {
    out.send({});
    return now + 10_ms;
  }
  Ports::Out<msg::Guidance> out;
};
}  // namespace

TEST_CASE("a node that publishes more often than it declared asserts, after a second's worth and two") {
  NodeUnderTest<TooOften> often({});
  CHECK_THROWS_WITH(often.run_until(1_s), Catch::Contains("test/out: more than 10 Hz with 12 at once"));
  CHECK(often.ports().now() == 130_ms);  // the 14th at 100 Hz: 12 at once, and one more by then
}

TEST_CASE("an event that does not advance or an oversized message asserts with its values") {
  NodeUnderTest<Stuck> stuck({});
  CHECK_THROWS_AS(stuck.run_until(1_s), AssertionError);
  NodeUnderTest<TooBig> big({});
  CHECK_THROWS_WITH(big.run_until(1_s), Catch::Contains("test/out") && Catch::Contains("declared at most 4"));
}

TEST_CASE("health goes out when it changes, at most once a second, with every count") {
  struct Counting {
    struct Config {};
    Counting(const Config&, Ports& p) : ports(p) {}
    SimTime step(SimTime now) {
      ports.count("late_tile");
      return now + 100_ms;
    }
    Ports& ports;
  };
  NodeUnderTest<Counting> node(Counting::Config{});
  const auto health = node.step_until<msg::Health>("health", 2_s);
  REQUIRE(health.size() == 3);
  CHECK(health[1].stamp_ns == 1'000'000'000);
  CHECK(health[1].counters.at(0).count == 11);
}

TEST_CASE("a message that cannot be read is its sender's mistake, with topic, seq and field") {
  NodeUnderTest<Listener> listener({});
  listener.give("command", command_at(0_s, 1.0));
  msg::Value::Map map;
  map.emplace_back("speed_mps", msg::Value{std::string("fast")});
  listener.give_body("command", 50_ms, msg::encode_value({map}));
  try {
    listener.run_until(100_ms);
    FAIL("it was taken");
  } catch (const PeerError& e) {
    CHECK(e.culprit == "given");
    CHECK(e.code == kExitDied);
    CHECK_THAT(e.what(), Catch::Contains("given/command: seq 1: speed_mps: is not a number"));
  }
}

TEST_CASE("a number that is not finite is refused, counted and its sender named; NaN may mean something") {
  NodeUnderTest<Listener> listener({});
  listener.give("command", command_at(0_s, 1.0), command_at(10_ms, std::nan("")), command_at(20_ms, INFINITY));
  listener.run_until(100_ms);
  CHECK(listener.node().received.size() == 1);  // with a depth_m of NaN, which says: as before
  const auto health = listener.step_until<msg::Health>("health", 1_s);
  REQUIRE_FALSE(health.empty());
  CHECK(health.back().state == "degraded");
  CHECK(health.back().message == "given/command: seq 2: speed_mps: is not a finite number");
  REQUIRE(health.back().counters.size() == 1);
  CHECK(health.back().counters[0].name == "refused_given/command.speed_mps");
  CHECK(health.back().counters[0].count == 2);
}

TEST_CASE("a message of a time that has been run is too late") {
  Ports ports("p");
  Stepper stepper(ports, [](SimTime now) { return now + 100_ms; });
  stepper.wire({{0, "a/b", 0, "guidance/1", "a", 0, 30_ms, 0}}, {}, {}, 1, 0, [](msg::Packet&&) {});
  stepper.run_to(150_ms);
  msg::Packet packet;
  packet.envelope.t_sim_ns = SimTime(70_ms).count();
  CHECK(stepper.too_late(packet));  // 70 + 30 ms: the event at 100 ms should have seen it
  packet.envelope.t_sim_ns += 1;
  CHECK_FALSE(stepper.too_late(packet));
}

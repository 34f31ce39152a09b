#include "tools/console/flow.h"

#include <catch2/catch.hpp>

using namespace ensonify;
using namespace ensonify::console;
using Catch::Matchers::Contains;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

const WallTime kStart = WallTime{} + std::chrono::hours(1);

struct Bench {
  Flow flow{kStart};
  WallTime now = kStart;

  explicit Bench(const std::vector<std::string>& topics) {
    msg::ConsoleWatch wish;
    for (const auto& topic : topics) wish.topics.push_back({topic, 1024, false, 0.0, 0.0});
    flow.watch(wish, now);
  }

  void offer(const std::string& topic, Way way, std::uint64_t seq) {
    auto packet = std::make_shared<msg::Packet>();
    packet->topic = topic;
    packet->envelope.seq = seq;
    flow.offer({topic, way, packet, now});
  }

  /// "topic seq" of what is sent next, or "".
  std::string next(std::size_t bytes = 1000) {
    const auto sending = flow.next(now);
    if (!sending) return "";
    flow.sent(bytes);
    return sending->offer.topic + " " + std::to_string(sending->offer.packet->envelope.seq);
  }

  msg::ConsoleFlowTopic report(const std::string& topic) {
    for (const auto& entry : flow.report(now).topics)
      if (entry.topic == topic) return entry;
    FAIL("no report of " << topic);
    return {};
  }
};

}  // namespace

TEST_CASE("of pictures one is on its way, and then the newest follows") {
  Bench bench({"bow/view"});
  for (std::uint64_t seq = 0; seq < 3; ++seq) {
    bench.offer("bow/view", Way::picture, seq);
    if (seq == 0) CHECK(bench.next() == "bow/view 0");
    else CHECK(bench.next().empty());
  }
  bench.now += milliseconds(20);
  bench.flow.drawn("bow/view", 0, bench.now);
  CHECK(bench.next() == "bow/view 2");
  CHECK(bench.report("bow/view").lost == 1);
}

TEST_CASE("lines come all and in order, until their bound: then the oldest go, counted") {
  Bench bench({"side/view"});
  const std::uint64_t most = Flow::kMostLines;
  for (std::uint64_t seq = 0; seq < most + 10; ++seq) bench.offer("side/view", Way::line, seq);
  for (std::uint64_t seq = 10; seq < most + 10; ++seq) {
    REQUIRE(bench.next() == "side/view " + std::to_string(seq));
    bench.flow.drawn("side/view", seq, bench.now);
  }
  CHECK(bench.next().empty());
  CHECK(bench.report("side/view").lost == 10);
}

TEST_CASE("lines run ahead of the viewer's answers by a bound") {
  Bench bench({"side/view"});
  for (std::uint64_t seq = 0; seq < 100; ++seq) bench.offer("side/view", Way::line, seq);
  std::size_t sent = 0;
  while (!bench.next().empty()) ++sent;
  CHECK(sent == Flow::kLinesAhead);
  bench.flow.drawn("side/view", 9, bench.now);  // and with it the nine before it
  sent = 0;
  while (!bench.next().empty()) ++sent;
  CHECK(sent == 10);
}

TEST_CASE("states come before lines, these before pictures; of a state the newest") {
  Bench bench({"bow/view", "side/view", "nav/health"});
  bench.offer("bow/view", Way::picture, 1);
  bench.offer("side/view", Way::line, 2);
  bench.offer("nav/health", Way::state, 3);
  bench.offer("nav/health", Way::state, 4);
  CHECK(bench.next() == "nav/health 4");
  CHECK(bench.next() == "side/view 2");
  CHECK(bench.next() == "bow/view 1");
  CHECK(bench.next().empty());
}

TEST_CASE("topics of one way take turns") {
  Bench bench({"a/view", "b/view"});
  for (std::uint64_t seq = 0; seq < 3; ++seq) {
    bench.offer("a/view", Way::line, seq);
    bench.offer("b/view", Way::line, seq);
  }
  CHECK(bench.next() == "a/view 0");
  CHECK(bench.next() == "b/view 0");
  CHECK(bench.next() == "a/view 1");
}

TEST_CASE("a picture that needs the link for longer than a quarter of a second is halved, however fast it is drawn") {
  Bench bench({"bow/view"});
  const auto cells_after = [&](milliseconds took) {
    static std::uint64_t seq = 0;
    bench.offer("bow/view", Way::picture, ++seq);
    const auto sending = bench.flow.next(bench.now);
    REQUIRE(sending);
    bench.flow.sent(50'000);
    bench.now += took;
    bench.flow.passed(bench.now, true);
    bench.now += milliseconds(300);  // drawing takes its time, too, which is not the link's
    bench.flow.answered(bench.now);
    bench.flow.drawn("bow/view", seq, bench.now);
    return sending->wish.cells;
  };
  CHECK(cells_after(milliseconds(300)) == 1024);
  CHECK(cells_after(milliseconds(260)) == 512);
  CHECK(cells_after(milliseconds(200)) == 256);
  for (int i = 0; i < Flow::kFastEnough; ++i) CHECK(cells_after(milliseconds(20)) == 256);
  CHECK(cells_after(milliseconds(20)) == 512);
  CHECK(bench.report("bow/view").halved == 1);
}

TEST_CASE("lines that fill the link are halved while it never empties") {
  Bench bench({"side/view"});
  for (std::uint64_t seq = 0; seq < 60; ++seq) {
    bench.offer("side/view", Way::line, seq);
    bench.next();
    bench.now += milliseconds(10);
    bench.flow.passed(bench.now, false);
  }
  CHECK(bench.report("side/view").halved == 2);  // after 0.26 s each
}

TEST_CASE("into a full link go states only") {
  Bench bench({"bow/view", "nav/health"});
  bench.offer("bow/view", Way::picture, 1);
  bench.offer("nav/health", Way::state, 2);
  const std::size_t full = Flow::kInLink + 1;
  const auto sending = bench.flow.next(bench.now, full);
  REQUIRE(sending);
  CHECK(sending->offer.topic == "nav/health");
  CHECK_FALSE(bench.flow.next(bench.now, full));
  CHECK(bench.next() == "bow/view 1");
}

TEST_CASE("a viewer that does not answer for 5 s is sent nothing, and comes back to the newest") {
  Bench bench({"bow/view", "side/view", "nav/health"});
  bench.now += seconds(4);
  bench.offer("nav/health", Way::state, 1);
  CHECK(bench.next() == "nav/health 1");
  bench.now += seconds(2);
  for (std::uint64_t seq = 0; seq < 5; ++seq) {
    bench.offer("side/view", Way::line, seq);
    bench.offer("bow/view", Way::picture, seq);
    CHECK(bench.next().empty());
  }
  CHECK(bench.flow.away(bench.now));
  CHECK(bench.flow.answered(bench.now));  // its caller offers the states anew
  CHECK_FALSE(bench.flow.answered(bench.now));
  CHECK(bench.next() == "bow/view 4");
  bench.offer("side/view", Way::line, 5);
  CHECK(bench.next() == "side/view 5");
  CHECK(bench.report("side/view").lost == 5);
}

TEST_CASE("a hidden page is sent nothing") {
  Bench bench({"nav/health"});
  msg::ConsoleWatch wish;
  wish.hidden = true;
  wish.topics.push_back({"nav/health", 1024, false, 0.0, 0.0});
  bench.flow.watch(wish, bench.now);
  bench.offer("nav/health", Way::state, 1);
  CHECK(bench.next().empty());
  wish.hidden = false;
  bench.flow.watch(wish, bench.now);
  CHECK(bench.flow.answered(bench.now));
  CHECK(bench.next() == "nav/health 1");
}

TEST_CASE("what is not watched is not kept, and a wish is held to its limits") {
  Bench bench({"bow/view"});
  bench.offer("side/view", Way::line, 0);
  CHECK(bench.next().empty());
  msg::ConsoleWatch wish;
  wish.topics.assign(65, {"x", 1024, false, 0.0, 0.0});
  CHECK_THROWS_WITH(bench.flow.watch(wish, bench.now), Contains("65 are too many; allowed: 64"));
  wish.topics.assign(1, {"x", 2000, false, 0.0, 0.0});
  CHECK_THROWS_WITH(bench.flow.watch(wish, bench.now), "x: cells 2000; allowed: 16 to 1024");
  wish.topics.assign(1, {"x", -1, false, 0.0, 0.0});
  CHECK_THROWS_WITH(bench.flow.watch(wish, bench.now), Contains("allowed: 16 to 1024"));
}

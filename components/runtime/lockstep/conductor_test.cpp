#include "components/runtime/lockstep/conductor.h"

#include <catch2/catch.hpp>
#include <random>

using namespace ensonify;

namespace {

/// vehicle 0 -> navigation 1 -> pilot 2 -> (delayed 100 ms) vehicle 0.
Conductor loop() { return Conductor(3, {{0, 1, 0_s}, {1, 2, 0_s}, {2, 0, 100_ms}}, {false, false, true}, 1_s); }

SimTime horizon_of(const std::vector<Conductor::Grant>& grants, std::size_t p) {
  for (const auto& grant : grants) {
    if (grant.participant == p) return grant.horizon;
  }
  return SimTime{-1};
}

}  // namespace

TEST_CASE("at the start only who depends on nothing undelayed may run, up to the delay") {
  Conductor conductor = loop();
  const auto grants = conductor.grants();
  REQUIRE(grants.size() == 1);
  CHECK(grants[0].participant == 0);
  CHECK(grants[0].horizon == 100_ms - SimTime{1});
}

TEST_CASE("a plain consumer runs to just before its producer's next promise") {
  Conductor conductor = loop();
  conductor.grants();
  conductor.done(0, 100_ms);
  CHECK(horizon_of(conductor.grants(), 1) == 100_ms - SimTime{1});
}

TEST_CASE("a producer may run a window ahead of its consumers, not more") {
  Conductor conductor(2, {{0, 1, 0_s}}, {false, false}, 1_s);
  CHECK(horizon_of(conductor.grants(), 0) == 1_s);
}

TEST_CASE("who is to stop runs no event from then on, but all that it has been granted") {
  Conductor conductor(2, {{0, 1, 0_s}}, {false, false}, 1_s);
  CHECK(horizon_of(conductor.grants(), 0) == 1_s);
  conductor.stop_before(0, 500_ms);  // too late for that
  CHECK_FALSE(conductor.stopped(0));
  conductor.done(0, 1_s);
  CHECK_FALSE(conductor.stopped(0));
  conductor.grants();
  conductor.done(0, 1_s);
  conductor.done(1, 1_s);
  CHECK(horizon_of(conductor.grants(), 0) == 1_s);  // not 2 s
  conductor.stop_before(0, 3_s);                    // an earlier stop stands
  conductor.done(0, 1100_ms);
  CHECK(conductor.stopped(0));
  CHECK(horizon_of(conductor.grants(), 0) == SimTime{-1});
}

TEST_CASE("the cap holds all participants, and next_capped gives pacing its next time") {
  Conductor conductor = loop();
  conductor.set_cap(SimTime{-1});
  CHECK(conductor.grants().empty());
  CHECK(conductor.next_capped() == 0_s);
  conductor.set_cap(10_ms);
  CHECK(horizon_of(conductor.grants(), 0) == 10_ms);
}

TEST_CASE("nobody can be past the end that a finisher may still ask for") {
  Conductor conductor(2, {}, {true, false}, 1_s);
  CHECK(horizon_of(conductor.grants(), 1) == 1_s);  // its event at 0 might be the last: everybody then stops at 1 s
  conductor.end_at(1_s);
  conductor.done(0, SimTime{1});
  conductor.done(1, 1_s + SimTime{1});
  CHECK(conductor.end() == 1_s);
  CHECK_FALSE(conductor.finished());  // 0 has events left
  conductor.grants();
  conductor.done(0, 2_s);
  CHECK(conductor.finished());
}

TEST_CASE("a promise cannot be taken back") {
  Conductor conductor = loop();
  conductor.grants();
  conductor.done(0, 100_ms);
  CHECK_THROWS_WITH(conductor.done(0, 50_ms), Catch::Contains("taken back"));
}

// The law behind everything: at an event at t every message that can have t_sim + delay <= t has been sent. Random
// graphs with a delayed edge in every cycle, random steps, grants finished in random order.
TEST_CASE("no participant ever acts before its inputs are certain, and time always goes on") {
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    const std::size_t n = 3 + static_cast<std::size_t>(pick(4));
    std::vector<Conductor::Edge> edges;
    for (std::size_t from = 0; from < n; ++from) {
      for (std::size_t to = 0; to < n; ++to) {
        if (from == to || pick(2) == 0) continue;
        edges.push_back(
            {from, to, to > from ? 0_ms : SimTime{1 + pick(200) * 1'000'000}});  // backward edges are delayed
      }
    }
    Conductor conductor(n, edges, std::vector<bool>(n, false), 1_s);
    conductor.end_at(5_s);
    std::vector<SimTime> next(n, 0_s);
    std::vector<SimTime> certain(n, SimTime{-1});  // nothing at or before this will be published any more
    std::vector<Conductor::Grant> running;
    int rounds = 0;
    while (!conductor.finished()) {
      REQUIRE(++rounds < 200'000);
      for (const auto& grant : conductor.grants()) running.push_back(grant);
      REQUIRE_FALSE(running.empty());  // no deadlock
      const auto chosen = static_cast<std::size_t>(pick(static_cast<int>(running.size())));
      const Conductor::Grant grant = running[chosen];
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(chosen));
      SimTime t = next[grant.participant];
      while (t <= grant.horizon) {
        for (const auto& edge : edges) {
          if (edge.to == grant.participant) REQUIRE(certain[edge.from] >= t - edge.delay);
        }
        t += SimTime{1 + pick(50) * 1'000'000};
      }
      next[grant.participant] = t;
      certain[grant.participant] = t - SimTime{1};
      conductor.done(grant.participant, t);
    }
    for (const SimTime t : next) CHECK(t > 5_s);
  }
}

TEST_CASE("whoever has nothing left to do is given no grants, though nothing ends the run") {
  Conductor conductor(2, {}, {false, false}, 1_s);
  CHECK(conductor.grants().size() == 2);
  conductor.done(0, kNever);
  conductor.done(1, 1_s);
  const auto grants = conductor.grants();
  REQUIRE(grants.size() == 1);
  CHECK(grants[0].participant == 1);
}

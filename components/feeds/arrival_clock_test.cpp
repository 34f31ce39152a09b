#include "components/feeds/arrival_clock.h"

#include <catch2/catch.hpp>
#include <random>

using namespace ensonify;

namespace {

/// Wall time, of a clock that began long before the run.
ArrivalClock::Wall wall(SimTime since_start) { return ArrivalClock::Wall{std::chrono::hours(99) + since_start}; }

}  // namespace

TEST_CASE("late events do not move arrivals") {
  std::minstd_rand chance(5);
  ArrivalClock clock;
  for (int i = 7; i < 1000; ++i) {
    const SimTime now = i * 10_ms;
    const SimTime late =
        from_seconds(i % 7 == 0 ? 0.0 : 0.02 * static_cast<double>(chance()) / std::minstd_rand::max());
    clock.event(now, wall(now + late));
    const SimTime off = clock.of(wall(now - 3_ms)) - (now - 3_ms);
    REQUIRE(off <= SimTime{0});
    REQUIRE(off > -SimTime{10'000});  // of the drift that is allowed for, over seven events
  }
}

TEST_CASE("time that passes before real time starts does not count") {
  for (const SimTime wait : {30_ms, 900_ms}) {
    ArrivalClock clock;
    clock.event(0_s, wall(0_s));
    for (int i = 1; i < 100; ++i) {
      clock.event(i * 10_ms, wall(wait + i * 10_ms));
      REQUIRE(std::chrono::abs(clock.of(wall(wait + i * 10_ms - 3_ms)) - (i * 10_ms - 3_ms)) < SimTime{100'000});
    }
  }
}

TEST_CASE("behind a pause, and below rate 1, an arrival is as long before its event as it was in fact") {
  ArrivalClock clock;
  clock.event(1_s, wall(1_s));
  clock.event(1_s + 10_ms, wall(4_s));  // it was stopped for 3 s
  CHECK(clock.of(wall(4_s - 2_ms)) == 1_s + 8_ms);
  for (int i = 2; i < 200; ++i) {  // at half the rate
    const SimTime now = 1_s + i * 10_ms, at = 4_s + 2 * i * 10_ms;
    clock.event(now, wall(at));
    const SimTime off = clock.of(wall(at - 2_ms)) - (now - 2_ms);
    REQUIRE(off >= SimTime{0});
    REQUIRE(off <= ArrivalClock::kMostLate);
  }
}

TEST_CASE("clocks that drift apart are followed") {
  ArrivalClock clock;
  for (int i = 0; i < 100'000; ++i) {
    const SimTime now = i * 10_ms, at = now + now / 20'000;  // wall time runs ahead
    clock.event(now, wall(at));
    REQUIRE(std::chrono::abs(clock.of(wall(at)) - now) < SimTime{1'000'000});
  }
}

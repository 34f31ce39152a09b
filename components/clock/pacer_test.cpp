#include "components/clock/pacer.h"

#include <catch2/catch.hpp>

using namespace ensonify;
using clock::Pacer;
using clock::WallTime;
using namespace std::chrono_literals;

namespace {
const WallTime kStart{100s};
Pacer started(std::optional<double> rate) {
  Pacer pacer(rate, 500_ms);
  pacer.start(kStart);
  return pacer;
}
}  // namespace

TEST_CASE("the cap follows wall time at the rate") {
  CHECK(started(1.0).cap(kStart + 2s) == 2_s);
  CHECK(started(4.0).cap(kStart + 2s) == 8_s);
  CHECK(started({}).cap(kStart) == kNever);
}

TEST_CASE("until it is started the cap stands at 0, and nothing is late") {
  Pacer pacer(1.0, 500_ms);
  CHECK(pacer.cap(kStart + 9s) == 0_s);
  CHECK_FALSE(pacer.when(1_s));
  CHECK(pacer.lateness(0_s, kStart + 9s) == 0_s);
  pacer.start(kStart + 9s);
  pacer.start(kStart + 10s);
  CHECK(pacer.cap(kStart + 11s) == 2_s);
  CHECK(Pacer({}, 500_ms).cap(kStart) == kNever);
}

TEST_CASE("waiting until `when` is enough: the cap has then reached the event") {
  for (const double rate : {0.3, 1.0, 4.0, 7.7}) {
    const Pacer pacer = started(rate);
    for (int n = 1; n < 1000; ++n) CHECK(pacer.cap(*pacer.when(event_time(n, {100, 1}))) >= event_time(n, {100, 1}));
  }
}

TEST_CASE("lateness is how far paced time is ahead; beyond the limit the origin moves once") {
  Pacer pacer = started(1.0);
  CHECK(pacer.lateness(1_s, kStart + 1300ms) == 300_ms);
  CHECK(pacer.slip(1_s, kStart + 1300ms) == 0_s);
  CHECK(pacer.slip(1_s, kStart + 1700ms) == 700_ms);
  CHECK(pacer.cap(kStart + 1700ms) == 1_s);
  CHECK(pacer.slip(1_s, kStart + 1700ms) == 0_s);
}

TEST_CASE("a pause holds the cap, a step moves it, resuming goes on from there") {
  Pacer pacer = started(1.0);
  pacer.pause(2_s, kStart + 2s);
  CHECK(pacer.cap(kStart + 9s) < 2_s);
  CHECK_FALSE(pacer.when(3_s));
  pacer.step_to(2100_ms, 2_s, kStart + 9s);
  CHECK(pacer.cap(kStart + 20s) == 2100_ms);
  pacer.resume(kStart + 30s);
  CHECK(pacer.cap(kStart + 31s) == 3100_ms);
}

TEST_CASE("another epoch begins at 0 at the rate in force, or waits there if paused") {
  Pacer pacer = started(2.0);
  CHECK(pacer.slip(1_s, kStart + 5s) == 9_s);
  pacer.begin_again();
  CHECK(pacer.cap(kStart + 6s) == 0_s);
  pacer.start(kStart + 6s);
  CHECK(pacer.cap(kStart + 7s) == 2_s);
  pacer.step_to(3_s, 2_s, kStart + 7s);
  pacer.begin_again();
  CHECK(pacer.paused());
  CHECK(pacer.cap(kStart + 9s) < 0_s);
  pacer.start(kStart + 9s);
  pacer.resume(kStart + 10s);
  CHECK(pacer.cap(kStart + 11s) == 2_s);
}

TEST_CASE("a change of rate goes on from where the run is") {
  Pacer pacer = started(1.0);
  pacer.set_rate(10.0, 2_s, kStart + 2s);
  CHECK(pacer.cap(kStart + 3s) == 12_s);
}

TEST_CASE("the fastest and the slowest rate allowed stay in range over days and years") {
  const Pacer fast = started(1e6);
  CHECK(fast.cap(kStart + 1h) == SimTime{3'600'000'000'000'000'000});
  CHECK(fast.cap(kStart + 72h) == kNever);
  const Pacer slow = started(1e-3);
  CHECK(*slow.when(std::chrono::hours(24 * 365 * 100)) > kStart + 8760h);
  CHECK(slow.cap(kStart + 1h) == 3600_ms);
}

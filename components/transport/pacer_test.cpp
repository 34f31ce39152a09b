#include "components/transport/pacer.h"

#include <catch2/catch.hpp>

using namespace ensonify;
using namespace std::chrono_literals;

namespace {

constexpr double kRate = 1e6;  // a kilobyte is a millisecond

std::vector<std::byte> datagram(std::size_t bytes) { return std::vector<std::byte>(bytes); }

/// Times at which all that waits leaves, where it is asked every `step`.
std::vector<Pacer::Time> departures(Pacer& pacer, Pacer::Time from, Pacer::Time step) {
  std::vector<Pacer::Time> times;
  for (Pacer::Time t = from; pacer.waiting() > 0; t += step) {
    while (pacer.take(t)) times.push_back(t);
  }
  return times;
}

}  // namespace

TEST_CASE("what is offered to an idle queue leaves at once, and the next when it has passed") {
  Pacer pacer(kRate);
  CHECK_FALSE(pacer.next().has_value());
  CHECK(pacer.offer(datagram(10'000), 5s));
  CHECK(pacer.offer(datagram(1'000), 5s));
  CHECK(pacer.next() == Pacer::Time(5s));
  CHECK(pacer.take(5s)->bytes.size() == 10'000);
  CHECK(pacer.next() == Pacer::Time(5s + 10ms));
  CHECK_FALSE(pacer.take(5s + 9ms).has_value());
  const auto second = pacer.take(5s + 10ms);
  REQUIRE(second);
  CHECK(second->bytes.size() == 1'000);
  CHECK(second->offered == Pacer::Time(5s));
  CHECK(pacer.waiting_bytes() == 0);
  // Idle time is not saved up.
  CHECK(pacer.offer(datagram(50'000), 60s));
  CHECK(pacer.offer(datagram(1'000), 60s));
  CHECK(pacer.take(60s));
  CHECK(pacer.next() == Pacer::Time(60s + 50ms));
}

TEST_CASE("a burst leaves at the rate, also where the queue is asked late each time") {
  Pacer pacer(kRate);
  for (int i = 0; i < 1'000; ++i) REQUIRE(pacer.offer(datagram(500), 0s));  // half a second of the rate
  const auto times = departures(pacer, 0s, 300us);
  REQUIRE(times.size() == 1'000);
  CHECK(times.back() >= 499'500us - Pacer::kCatchUp);
  CHECK(times.back() <= 502ms);
  // In no 10 ms more than the rate allows, and what is caught up.
  for (std::size_t i = 0, end = 0; i < times.size(); ++i) {
    while (end < times.size() && times[end] < times[i] + 10ms) ++end;
    REQUIRE(end - i <= 20 + 5);
  }
}

TEST_CASE("what would leave more than two seconds later is dropped as a whole datagram") {
  Pacer pacer(kRate);
  int taken = 0;
  for (int i = 0; i < 100; ++i) taken += pacer.offer(datagram(60'000), 0s) ? 1 : 0;
  CHECK(taken == 33);  // 1.98 s of the rate
  CHECK(pacer.waiting_bytes() == 33U * 60'000U);
  CHECK(pacer.offer(datagram(20'000), 0s));
  CHECK_FALSE(pacer.offer(datagram(1), 0s));
  CHECK(departures(pacer, 0s, 1ms).size() == 34);
}

TEST_CASE("one datagram fits at any rate") {
  Pacer pacer(100.0);
  CHECK(pacer.offer(datagram(64'000), 0s));
  CHECK_FALSE(pacer.offer(datagram(1), 0s));
  CHECK(pacer.take(0s));
  CHECK(pacer.offer(datagram(1), 1s));
  CHECK(pacer.next() == Pacer::Time(640s));
}

#include "components/runtime/sim_time.h"

#include <catch2/catch.hpp>

using namespace ensonify;

TEST_CASE("event times are computed from the count, so that 15 Hz is exact every second") {
  const Rate rate{15, 1};
  CHECK(event_time(1, rate) == SimTime{66'666'666});  // floor of 66 666 666.67 ns
  for (std::int64_t s = 0; s < 100'000; s += 999) CHECK(event_time(15 * s, rate) == std::chrono::seconds(s));
}

TEST_CASE("a fractional rate and a phase are exact too") {
  CHECK(event_time(30000, {30000, 1001}) == std::chrono::seconds(1001));  // 29.97 Hz
  CHECK(event_time(2, {10, 1}, 5_ms) == 205_ms);
}

TEST_CASE("a periodic activity is due once for each of its events") {
  Periodic tenth({10, 1});
  CHECK(tenth.due(0_s));
  CHECK_FALSE(tenth.due(0_s));
  CHECK(tenth.next() == 100_ms);
  CHECK(tenth.due(100_ms));
  CHECK(tenth.count() == 2);
}

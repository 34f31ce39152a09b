#include <catch2/catch.hpp>

#include "components/multibeam/auto_range.h"
#include "components/multibeam/ping_clock.h"

using namespace ensonify;

TEST_CASE("short pings keep the beat exactly") {
  PingClock clock({15, 1}, 1_ms);
  for (int n = 0; n < 1000; ++n) {
    REQUIRE(clock.next() == event_time(n, {15, 1}));
    clock.transmitted(50_ms);
  }
}

TEST_CASE("a long ping moves the beat: never less than listening plus dead time") {
  PingClock clock({10, 1}, 1_ms);
  clock.transmitted(120_ms);
  CHECK(clock.next() == 121_ms);
  clock.transmitted(50_ms);
  CHECK(clock.next() == 221_ms);
  clock.transmitted(99_ms);
  CHECK(clock.next() == 321_ms);
  clock.transmitted(100_ms);
  CHECK(clock.next() == 422_ms);
  clock.skipped();
  CHECK(clock.next() == 522_ms);
}

TEST_CASE("auto range follows the farthest detections and falls back to the longest") {
  AutoRange range(200);
  CHECK(range.range_m() == 200);
  std::vector<double> ranges;
  for (int beam = 0; beam < 256; ++beam) ranges.push_back(20.0 + beam * 0.1);  // to 45.5 m
  ranges.back() = 190;                                                         // an outlier
  range.update(ranges, 256, 200);
  CHECK(range.range_m() == Approx(50).margin(1));
  ranges.resize(200);  // the outer beams have lost the bottom
  range.update(ranges, 256, 60);
  CHECK(range.range_m() == 66);
  ranges.resize(10);
  range.update(ranges, 256, 60);
  CHECK(range.range_m() == 200);
}

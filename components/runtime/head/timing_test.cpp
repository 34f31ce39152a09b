#include <catch2/catch.hpp>

#include "components/runtime/head/auto_range.h"
#include "components/runtime/head/ping_clock.h"

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

TEST_CASE("auto range follows the edge of the swath and falls back to the longest") {
  AutoRange range(200, 1.1, 256);
  CHECK(range.range_m() == 200);
  std::vector<HeardBottom> level;  // 20 m below
  for (int beam = 0; beam < 256; ++beam) {
    const double angle = -1.1 + 2.2 * beam / 255;
    level.push_back({angle, 20.0 / std::cos(angle)});
  }
  const double edge_m = 20.0 / std::cos(1.1);
  const auto settled = [&](std::vector<HeardBottom> heard, double listened_m) {
    range.update(heard, listened_m);
    return range.range_m();
  };
  CHECK(settled(level, 200) == std::ceil(1.13 * edge_m));
  auto outlier = level;
  outlier[100].range_m = 190;
  CHECK(settled(outlier, 200) == std::ceil(1.13 * edge_m));
  // The outer beams of one side are lost: what the others say of the edge still holds.
  CHECK(settled({level.begin() + 20, level.end()}, 45) == std::ceil(1.13 * edge_m));
  CHECK(settled({level.begin() + 20, level.end() - 20}, 45) == std::ceil(1.13 * edge_m));
  // Half of them are lost, as after a step down: listen longer.
  CHECK(settled({level.begin() + 70, level.end() - 70}, 60) == 66);
  CHECK(settled({level.begin(), level.begin() + 10}, 60) == 200);
}

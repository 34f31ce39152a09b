#include "tools/topic/meter.h"

#include <catch2/catch.hpp>

using Catch::WithinAbs;

namespace ensonify::topic_tool {

using std::chrono::milliseconds;

TEST_CASE("a run at twice real time shows 10 Hz sim and 20 Hz wall time, without jitter") {
  Meter meter(100);
  for (int n = 0; n < 11; ++n) {
    meter.add(WallTime{} + n * milliseconds(50), n * 100_ms, static_cast<std::uint64_t>(n), 1000);
  }
  const Traffic t = meter.traffic();
  CHECK(t.received == 11);
  CHECK(t.dropped == 0);
  CHECK(t.sim_hz == Approx(10.0));
  CHECK(t.wall_hz == Approx(20.0));
  CHECK(t.wall.mean_s == Approx(0.05));
  CHECK_THAT(t.wall.jitter_s, WithinAbs(0.0, 1e-12));
  CHECK(t.wall_bytes_per_s == Approx(20'000.0));
  CHECK(t.sim_bytes_per_s == Approx(10'000.0));
}

TEST_CASE("jitter is the standard deviation of the intervals") {
  Meter meter(100);
  meter.add(WallTime{}, 0_s, 0, 1);
  meter.add(WallTime{} + milliseconds(40), 100_ms, 1, 1);
  meter.add(WallTime{} + milliseconds(100), 200_ms, 2, 3);
  const Traffic t = meter.traffic();
  CHECK(t.wall.mean_s == Approx(0.05));  // 40 and 60 ms
  CHECK(t.wall.jitter_s == Approx(0.01));
  CHECK_THAT(t.sim.jitter_s, WithinAbs(0.0, 1e-12));
  CHECK(t.min_bytes == 1);
  CHECK(t.max_bytes == 3);
}

TEST_CASE("dropped messages are counted and do not lower the rate, nor enter the intervals") {
  Meter meter(100);
  for (const std::uint64_t seq : {0, 1, 5, 6}) {
    meter.add(WallTime{} + static_cast<int>(seq) * milliseconds(100), static_cast<int>(seq) * 100_ms, seq, 10);
  }
  const Traffic t = meter.traffic();
  CHECK(t.received == 4);
  CHECK(t.dropped == 3);
  CHECK(t.wall_hz == Approx(10.0));
  CHECK(t.wall.mean_s == Approx(0.1));
}

TEST_CASE("with another epoch, whose messages count from 0 again, rates begin anew") {
  Meter meter(100);
  for (int n = 0; n < 5; ++n) meter.add(WallTime{} + n * milliseconds(100), 20_s + n * 100_ms, 200 + n, 10);
  meter.add(WallTime{} + milliseconds(700), 0_s, 0, 10);
  CHECK(meter.traffic().sim_hz == 0.0);
  meter.add(WallTime{} + milliseconds(750), 100_ms, 1, 10);
  CHECK(meter.traffic().sim_hz == Approx(10.0));
  CHECK(meter.traffic().wall_hz == Approx(20.0));
  CHECK(meter.traffic().dropped == 0);
  CHECK(meter.traffic().received == 7);
}

TEST_CASE("the window forgets what is older, and one message gives no rate") {
  Meter meter(2);
  CHECK(meter.traffic().received == 0);
  meter.add(WallTime{}, 0_s, 0, 10);
  CHECK(meter.traffic().wall_hz == 0.0);
  meter.add(WallTime{} + milliseconds(1000), 1_s, 1, 10);
  meter.add(WallTime{} + milliseconds(1100), 1100_ms, 2, 10);
  CHECK(meter.traffic().wall_hz == Approx(10.0));
  CHECK(meter.traffic().received == 3);
}

}  // namespace ensonify::topic_tool

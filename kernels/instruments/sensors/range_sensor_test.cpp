#include "kernels/instruments/sensors/range_sensor.h"

#include <catch2/catch.hpp>

using namespace ensonify;
using namespace ensonify::sensors;

TEST_CASE("an altimeter answers within its range, and fails as often as stated") {
  RangeSensor sensor({.dropout = 0.25}, random::Stream(1, "altimeter"));
  int answers = 0;
  for (int i = 0; i < 4000; ++i) {
    if (const auto range = sensor.measure(12.5, 0.1)) {
      REQUIRE(*range == 12.5);
      ++answers;
    }
  }
  CHECK(answers / 4000.0 == Approx(0.75).margin(0.028));  // four times sqrt(0.75 * 0.25 / 4000)
  RangeSensor sure({}, random::Stream(1, "altimeter"));
  CHECK(!sure.measure(0.2, 0.1));
  CHECK(!sure.measure(101.0, 0.1));
  CHECK(!sure.measure(std::nullopt, 0.1));
  CHECK(sure.measure(100.0, 0.1));
}

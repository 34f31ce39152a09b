#include "kernels/water/sound_speed.h"

#include <catch2/catch.hpp>

using namespace ensonify::water;

TEST_CASE("sound speed matches the published check value") {
  CHECK(sound_speed_mps(25.0, 35.0, 1000.0) == Approx(1550.744).margin(1e-3));
}

TEST_CASE("sound speed rises with depth in isothermal water, and with warmth and salt") {
  for (double depth = 0; depth < 8000; depth += 500) {
    CHECK(sound_speed_mps(10, 35, depth + 500) > sound_speed_mps(10, 35, depth));
  }
  CHECK(sound_speed_mps(11, 35, 0) > sound_speed_mps(10, 35, 0));
  CHECK(sound_speed_mps(10, 36, 0) > sound_speed_mps(10, 35, 0));
}

TEST_CASE("the range of the fit is known") {
  CHECK(in_range(2, 25, 0));
  CHECK_FALSE(in_range(1.9, 35, 0));
  CHECK_FALSE(in_range(10, 41, 0));
  CHECK_FALSE(in_range(10, 35, -1));
}

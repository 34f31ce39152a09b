#include "components/formats/time_of_day.h"

#include <catch2/catch.hpp>

using namespace ensonify::formats;

TEST_CASE("steps of the time of day go the short way") {
  CHECK(time_of_day_step_s(kDay_s - 1.0, 1.0) == 2.0);
  CHECK(time_of_day_step_s(1.0, kDay_s - 1.0) == -2.0);
}

TEST_CASE("a leap second is a second of its own, both ways and in parts") {
  CHECK(time_of_day_step_s(kDay_s - 1.0, kDay_s) == 1.0);  // 23:59:59 to 23:59:60
  CHECK(time_of_day_step_s(kDay_s, 0.0) == 1.0);
  CHECK(time_of_day_step_s(kDay_s + 0.25, kDay_s + 0.5) == 0.25);
  CHECK(time_of_day_step_s(kDay_s + 0.75, 0.0) == 0.25);
  CHECK(time_of_day_step_s(0.0, kDay_s) == -1.0);
  CHECK(time_of_day_step_s(0.25, kDay_s + 0.5) == -0.75);
}

TEST_CASE("59.999 rounded up to 60 makes no second more") { CHECK(time_of_day_step_s(kDay_s, 1.0) == 1.0); }

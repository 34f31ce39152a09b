#include "components/nav_feed/time_base.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "components/nav_feed/wording.h"

using namespace ensonify;
using Catch::WithinAbs;

namespace {

constexpr double kHour_s = 3600.0, kDay_s = 86400.0;

/// Bound at noon of the first day, which is the run's second 10.
TimeBase at_noon() {
  TimeBase base;
  base.bind(12 * kHour_s, 10.0);
  return base;
}

}  // namespace

TEST_CASE("a time of day is the day's nearest to its arrival") {
  const TimeBase base = at_noon();
  CHECK(base.run_s(12 * kHour_s + 5.0, 15.02) == 15.0);
  CHECK(base.run_s(12 * kHour_s + 5.0, 15.02 + 3 * kDay_s) == 15.0 + 3 * kDay_s);  // nothing came for three days
  CHECK_THAT(base.ahead_s(15 * kHour_s, 10.0), WithinAbs(3 * kHour_s, 1e-9));
  CHECK_THAT(base.ahead_s(9 * kHour_s, 10.0), WithinAbs(-3 * kHour_s, 1e-9));
  CHECK_THAT(base.ahead_s(12 * kHour_s + 18.0, 10.0), WithinAbs(18.0, 1e-9));
}

TEST_CASE("days follow each other at midnight, and their stragglers stay in their own") {
  TimeBase base = at_noon();
  for (int half_hour = 1; half_hour <= 200; ++half_hour) {
    const double since_s = 0.5 * kHour_s * half_hour, time_of_day_s = std::fmod(12 * kHour_s + since_s, kDay_s);
    REQUIRE_THAT(base.follow(time_of_day_s, 10.0 + since_s + 0.1), WithinAbs(10.0 + since_s, 1e-6));
  }
  TimeBase night;
  night.bind(kDay_s - 1.0, 100.0);
  CHECK_THAT(night.follow(0.5, 101.6), WithinAbs(101.5, 1e-9));
  CHECK_THAT(night.follow(kDay_s - 0.1, 101.7), WithinAbs(100.9, 1e-9));
  CHECK_THAT(night.follow(1.0, 102.1), WithinAbs(102.0, 1e-9));
}

TEST_CASE("a leap second makes its day a second longer, to both sides of it") {
  TimeBase base;
  base.bind(kDay_s - 1.0, 100.0);                                         // 23:59:59
  CHECK_THAT(base.follow(kDay_s, 101.02), WithinAbs(101.0, 1e-9));        // 23:59:60
  CHECK_THAT(base.follow(kDay_s + 0.5, 101.52), WithinAbs(101.5, 1e-9));  // 23:59:60.5
  CHECK_THAT(base.follow(0.0, 102.02), WithinAbs(102.0, 1e-9));
  CHECK_THAT(base.run_s(kDay_s + 0.7, 102.1), WithinAbs(101.7, 1e-9));  // a straggler
  CHECK_THAT(base.follow(1.0, 103.02), WithinAbs(103.0, 1e-9));
  CHECK_THAT(base.follow(1.0, 103.02 + kDay_s), WithinAbs(103.0 + kDay_s, 1e-9));  // the next day is plain again
}

TEST_CASE("59.999 rounded up to 60 is no leap second") {
  TimeBase base;
  base.bind(kDay_s - 1.0, 100.0);
  CHECK_THAT(base.follow(kDay_s, 101.02), WithinAbs(101.0, 1e-9));  // 23:59:60 stands for 00:00:00
  CHECK_THAT(base.follow(1.0, 102.02), WithinAbs(102.0, 1e-9));
  CHECK_THAT(base.follow(2.0, 103.02), WithinAbs(103.0, 1e-9));
}

TEST_CASE("durations read as they are said") {
  CHECK(duration_text(-3 * kHour_s) == "3 h 0 min");
  CHECK(duration_text(3 * kHour_s - 0.4) == "3 h 0 min");
  CHECK(duration_text(125.0) == "2 min 5 s");
  CHECK(duration_text(18.0) == "18.0 s");
  CHECK(duration_text(59.99) == "1 min 0 s");
}

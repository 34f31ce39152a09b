#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/instruments/sensors/gnss.h"

using namespace ensonify;
using namespace ensonify::sensors;
using Catch::WithinAbs;

namespace {

const random::Stream kStream(1, "usbl");

}  // namespace

TEST_CASE("without noise a transponder is where it is, as old as sound takes") {
  const UsblErrors exact{.range_white_m = 0, .bearing_white_rad = 0};
  const frames::Vec3 place(30, -40, 120);
  const auto reading = locate(exact, place, kStream, 1);
  REQUIRE(reading);
  CHECK((reading->place_array_m - place).norm() < 1e-9);
  CHECK(reading->age_s == Approx(130.0 / 1500.0));
}

TEST_CASE("a place is as uncertain as stated, by angle and by range") {
  const UsblErrors errors{.range_white_m = 0.1, .bearing_white_rad = 0.003};
  const frames::Vec3 place(60, 20, 200);
  frames::Vec3 squares = frames::Vec3::Zero(), stated = frames::Vec3::Zero();
  constexpr int kCount = 4000;  // 1.1 %, four times that is allowed
  for (std::uint64_t n = 0; n < kCount; ++n) {
    const auto reading = locate(errors, place, kStream, n);
    squares += (reading->place_array_m - place).cwiseAbs2();
    stated += reading->sigma_array_m / kCount;
  }
  for (int i = 0; i < 3; ++i) CHECK(std::sqrt(squares[i] / kCount) == Approx(stated[i]).epsilon(0.05));
}

TEST_CASE("wrong sound speed scales the range; no reply beyond range or opening angle") {
  const UsblErrors errors{.range_white_m = 0, .sound_speed_scale = 0.01, .bearing_white_rad = 0};
  CHECK(locate(errors, {0, 0, 100}, kStream, 1)->place_array_m.z() == Approx(101.0));
  CHECK(!locate(errors, {0, 0, 1001}, kStream, 1));
  CHECK(!locate(errors, {100, 0, 10}, kStream, 1));  // 84 degrees off the axis
  CHECK(!locate(errors, frames::Vec3::Zero(), kStream, 1));
}

TEST_CASE("reflections are as frequent as stated, and longer") {
  const UsblErrors errors{.range_white_m = 0, .bearing_white_rad = 0, .outlier = 0.1};
  int wrong = 0;
  for (std::uint64_t n = 0; n < 4000; ++n) {
    if (locate(errors, {30, 0, 100}, kStream, n)->place_array_m.norm() > 105.0) ++wrong;
  }

  CHECK_THAT(wrong / 4000.0, WithinAbs(0.1 * 0.9943, 0.019));  // all but the least; four times sqrt(0.1 * 0.9 / 4000)
}

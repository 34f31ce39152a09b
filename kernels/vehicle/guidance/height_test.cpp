#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/vehicle/guidance/laws.h"
#include "kernels/vehicle/motion/kinematics.h"

using namespace ensonify;
using namespace ensonify::guidance;
using Catch::WithinAbs;

TEST_CASE("constant slope is tracked without lag, a step with the filter's time constant") {
  BottomTrack track;
  for (int i = 0; i <= 600; ++i) track = track_bottom(track, 10.0, 20.0 + 0.1 * 0.3 * i, 0.1, 2.0);
  CHECK(track.depth_m == Approx(48.0).epsilon(1e-9));
  CHECK(track.rate_mps == Approx(0.3).epsilon(1e-9));

  // After a step the error of two equal poles z = exp(-dt / T) is z^n (1 - n (1 - z) ...): below 1 % after 10 T.
  for (int i = 0; i < 200; ++i) track = track_bottom(track, 10.0, 30.0, 0.1, 2.0);
  CHECK_THAT(track.depth_m, WithinAbs(40.0, 0.08));
}

TEST_CASE("the order is the bottom less the altitude, within the depths allowed") {
  const HeightRules rules{5.0, 2.0, 1.0, 30.0, 0.0};
  CHECK(follow_bottom(rules, {true, 20.0, 0.0}, 15.0, 5.0).depth_m == 15.0);
  CHECK(follow_bottom(rules, {true, 50.0, 0.0}, 15.0, 35.0).depth_m == 30.0);
  CHECK(follow_bottom(rules, {true, 4.0, 0.0}, 1.5, 2.5).depth_m == 1.0);
  CHECK(follow_bottom(rules, {}, 15.0, 0.0).depth_m == 15.0);
  CHECK_FALSE(follow_bottom(rules, {true, 20.0, 0.0}, 15.0, 5.0).too_low);
}

TEST_CASE("the vehicle climbs early over a rising bottom, and waits over a falling one") {
  const HeightRules rules{5.0, 2.0, 0.0, 1e4, 10.0};
  CHECK(follow_bottom(rules, {true, 20.0, -0.2}, 15.0, 5.0).depth_m == Approx(13.0));
  CHECK(follow_bottom(rules, {true, 20.0, 0.2}, 15.0, 5.0).depth_m == 15.0);
}

TEST_CASE("below the obstacle floor the vehicle climbs, whatever the command") {
  const HeightRules rules{5.0, 2.0, 0.0, 1e4, 0.0};
  const HeightOrder order = follow_bottom(rules, {true, 20.0, 0.0}, 18.5, 1.5);
  CHECK(order.too_low);
  CHECK(order.depth_m == Approx(17.5));
  CHECK(hold_depth(rules, {true, 20.0, 0.0}, 19.0, 15.0, 5.0).depth_m == Approx(18.0));
  CHECK(hold_depth(rules, {true, 20.0, 0.0}, 12.0, 15.0, 5.0).depth_m == Approx(12.0));
  CHECK(hold_depth(rules, {true, 20.0, 0.0}, 12.0, 19.0, 1.0).too_low);
  CHECK(hold_depth(rules, {}, 12.0, 19.0, 1.0).depth_m == Approx(12.0));
}

TEST_CASE("over a ridge of 1 in 5 a vehicle that climbs 0.5 m/s keeps its floor") {
  // 2 m/s over a ridge of slope 0.2: the bottom rises 0.4 m/s. Looking 10 s ahead outweighs the filter's settling.
  const HeightRules rules{5.0, 2.0, 0.0, 1e4, 10.0};
  BottomTrack track;
  motion::Moving at{-25.0, 0.0, 0.0};
  double least_altitude_m = 1e9;
  for (int i = 0; i < 3000; ++i) {
    const double x_m = 2.0 * 0.1 * i;
    const double bottom_m = 30.0 - 0.2 * std::max(0.0, 60.0 - std::abs(x_m - 200.0));
    const double altitude_m = bottom_m + at.value;
    least_altitude_m = std::min(least_altitude_m, altitude_m);
    track = track_bottom(track, -at.value, altitude_m, 0.1, 2.0);
    const HeightOrder order = follow_bottom(rules, track, -at.value, altitude_m);
    CHECK_FALSE(order.too_low);
    at = motion::approach(at, -order.depth_m, 0.1, 0.5, 0.2);
  }
  CHECK(least_altitude_m > 3.5);
  CHECK_THAT(-at.value, WithinAbs(25.0, 0.01));
}

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "kernels/vehicle/motion/kinematics.h"

using namespace ensonify::motion;
using Catch::WithinAbs;

TEST_CASE("a long climb is v/a of speeding up, a cruise, and v/a of slowing down") {
  // 0.5 m/s at 0.25 m/s^2: 2 s and 0.5 m at either end, 9 m at 0.5 m/s between: 22 s for 10 m.
  const auto at = [](double t_s) { return approach({}, 10.0, t_s, 0.5, 0.25); };
  CHECK(at(2.0).value == Approx(0.5));
  CHECK(at(2.0).rate == Approx(0.5));
  CHECK(at(1.0).acceleration == 0.25);
  CHECK(at(11.0).value == Approx(5.0));
  CHECK(at(11.0).acceleration == 0.0);
  CHECK(at(21.0).value == Approx(10.0 - 0.125));
  CHECK(at(21.0).acceleration == -0.25);
  CHECK(at(22.001).value == 10.0);
  CHECK(at(22.001).rate == 0.0);
}

TEST_CASE("a short climb never reaches full speed: 2 sqrt(d/a) seconds") {
  const double t_s = 2.0 * std::sqrt(0.16 / 0.25);
  CHECK(approach({}, -0.16, 0.5 * t_s, 0.5, 0.25).rate == Approx(-0.2));
  CHECK(approach({}, -0.16, t_s + 1e-9, 0.5, 0.25).value == -0.16);
}

TEST_CASE("a climb past or away from its target brakes, overshoots by v^2/2a and returns") {
  const Moving falling{0.0, -0.5, 0.0};
  const Moving lowest = approach(falling, 3.0, 2.0, 0.5, 0.25);
  CHECK(lowest.value == Approx(-0.5));
  CHECK_THAT(lowest.rate, WithinAbs(0.0, 1e-12));
  CHECK(approach(falling, 3.0, 100.0, 0.5, 0.25).value == 3.0);
  const Moving too_fast{0.0, 0.5, 0.0};
  CHECK(approach(too_fast, 0.1, 2.0, 0.5, 0.25).value == Approx(0.5));
  CHECK(approach(too_fast, 0.1, 100.0, 0.5, 0.25).value == 0.1);
}

TEST_CASE("many small steps of a climb are one large one") {
  Moving often{2.0, 0.3, 0.0};
  const Moving once = approach(often, -7.0, 12.3, 0.5, 0.1);
  for (int i = 0; i < 1230; ++i) often = approach(often, -7.0, 0.01, 0.5, 0.1);
  CHECK_THAT(often.value, WithinAbs(once.value, 1e-9));
  CHECK_THAT(often.rate, WithinAbs(once.rate, 1e-9));
}

TEST_CASE("without inertia a climb begins and ends at once") {
  const double unlimited = std::numeric_limits<double>::infinity();
  CHECK(approach({}, 3.0, 2.0, 0.5, unlimited).value == 1.0);
  CHECK(approach({}, 3.0, 7.0, 0.5, unlimited).value == 3.0);
}

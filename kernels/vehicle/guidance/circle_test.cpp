#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/vehicle/guidance/laws.h"

using namespace ensonify;
using namespace ensonify::guidance;
using Catch::WithinAbs;
constexpr double kPi = std::numbers::pi;

TEST_CASE("on the circle the course is its tangent, far off it points at the centre") {
  const Circle circle{{100, 50}, 20.0, true};
  CHECK(circle_course_rad(circle, {100, 70}, 3.0) == Approx(0.5 * kPi));  // north of the centre: to the east
  CHECK(circle_course_rad({{100, 50}, 20.0, false}, {100, 70}, 3.0) == Approx(1.5 * kPi));
  CHECK_THAT(circle_course_rad(circle, {100, 50 + 1e9}, 3.0), WithinAbs(kPi, 1e-6));
  CHECK(outside_m(circle, {130, 50}) == Approx(10.0));
  CHECK(circle_course_rad(circle, {100, 50}, 3.0) == 0.0);
}

TEST_CASE("following the course leads onto the circle as d' = -U sin(atan(gain d / r)) says") {
  // Near the circle d' = -U gain d / r: the distance falls exponentially.
  const Circle circle{{0, 0}, 20.0, true};
  const double speed_mps = 2.0, gain = 3.0, dt_s = 1e-3;
  Vec2 place(0.0, 20.2);
  double swept = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const double course = circle_course_rad(circle, place, gain);
    const Vec2 next = place + speed_mps * dt_s * Vec2(std::sin(course), std::cos(course));
    swept += swept_rad(circle, place, next);
    place = next;
  }
  // Tolerances: the chords' drift outwards, U^2 dt / (2 r) = 1e-4 m/s against a return of 0.3 /s, is 3.3e-4 m.
  CHECK_THAT(outside_m(circle, place), WithinAbs(0.2 * std::exp(-speed_mps * gain / 20.0 * 5.0), 5e-4));
  CHECK(swept == Approx(speed_mps * 5.0 / 20.0).epsilon(0.01));  // on a radius up to 1 % larger
}

TEST_CASE("the sweep counts turns in the circle's sense") {
  const Circle clockwise{{0, 0}, 5.0, true}, other{{0, 0}, 5.0, false};
  CHECK(swept_rad(clockwise, {0, 5}, {5, 0}) == Approx(0.5 * kPi));
  CHECK(swept_rad(other, {0, 5}, {5, 0}) == Approx(-0.5 * kPi));
  CHECK(swept_rad(clockwise, {0, 0}, {5, 0}) == 0.0);
}

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/vehicle/guidance/laws.h"

using namespace ensonify;
using namespace ensonify::guidance;
constexpr double kPi = std::numbers::pi;

TEST_CASE("drift across one heading is learned exponentially, the rest on another heading") {
  const Vec2 current(0.4, -0.3);
  Vec2 drift = Vec2::Zero();
  const auto run_line = [&](double heading_rad, double for_s) {
    for (double t = 0.0; t < for_s - 1e-9; t += 0.1) {
      const Vec2 velocity = 2.0 * Vec2(std::sin(heading_rad), std::cos(heading_rad)) + current;
      drift = learn_drift(drift, velocity, heading_rad, 0.1, 10.0);
    }
  };
  run_line(0.0, 10.0);  // to north: east is across
  CHECK(drift.x() == Approx(0.4 * (1.0 - std::exp(-1.0))));
  CHECK(drift.y() == 0.0);
  run_line(0.0, 100.0);
  run_line(0.5 * kPi, 200.0);
  CHECK((drift - current).norm() < 1e-4);
}

TEST_CASE("with the speed through the water all of a current is learned on one heading") {
  const Vec2 current(0.4, -0.3);
  Vec2 learned = Vec2::Zero();
  for (int i = 0; i < 100; ++i) learned = learn_current(learned, Vec2(2.0, 0.0) + current, 0.5 * kPi, 2.0, 0.1, 10.0);
  CHECK((learned - (1.0 - std::exp(-1.0)) * current).norm() < 1e-12);
}

TEST_CASE("the heading for a course points upstream so that the way made good is the course") {
  const Vec2 drift(0.5, 0.2);
  for (double course = 0.0; course < 2.0 * kPi; course += 0.3) {
    const double heading = heading_for_course_rad(course, 1.5, drift);
    const Vec2 ground = 1.5 * Vec2(std::sin(heading), std::cos(heading)) + drift;
    CHECK(std::abs(frames::wrap_pi(std::atan2(ground.x(), ground.y()) - course)) < 1e-12);
  }
}

TEST_CASE("too strong a drift is crabbed at asin 0.9; at rest the heading is the course") {
  CHECK(heading_for_course_rad(0.0, 1.0, {5.0, 0.0}) == Approx(2.0 * kPi - std::asin(0.9)));
  CHECK(heading_for_course_rad(1.0, 0.0, {5.0, 0.0}) == Approx(1.0));
}

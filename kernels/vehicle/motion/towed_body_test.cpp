#include "kernels/vehicle/motion/towed_body.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify::motion;
using Catch::WithinAbs;
using ensonify::frames::Vec2;
using ensonify::frames::Vec3;
constexpr double kPi = std::numbers::pi;

namespace {

const TowCable kCable{100, 0.01, 2.0, 1.2, 0.015};
const TowedBody kFish{300, 0.05};

}  // namespace

TEST_CASE("at rest the cable hangs straight down") {
  const TowShape shape = tow_shape(kCable, kFish, 0.0);
  CHECK(shape.depth_m == Approx(100));
  CHECK_THAT(shape.layback_m, WithinAbs(0, 1e-9));
  CHECK(shape.tension_n == Approx(300 + 200));
}

TEST_CASE("a thin light cable is a straight line at the angle of the body's weight and drag") {
  const TowShape shape = tow_shape({100, 1e-9, 0.0, 1.2, 0.015}, kFish, 3.0);
  const double drag_n = 0.5 * 1025 * 9 * 0.05;
  CHECK(shape.depth_m == Approx(100 * 300 / std::hypot(300, drag_n)));
  CHECK(shape.layback_m == Approx(100 * drag_n / std::hypot(300, drag_n)));
}

TEST_CASE("a heavy cable without drag is a catenary") {
  const TowShape shape = tow_shape({100, 0.01, 4.0, 0.0, 0.0}, kFish, 3.0);
  // Tension has the horizontal part H throughout and the vertical part W + w s: closed forms of the catenary.
  const double H = 0.5 * 1025 * 9 * 0.05, w = 4.0, a = H / w;
  const double below = 300 / H, above = (300 + w * 100) / H;
  CHECK(shape.depth_m == Approx(a * (std::hypot(1, above) - std::hypot(1, below))).epsilon(1e-5));
  CHECK(shape.layback_m == Approx(a * (std::asinh(above) - std::asinh(below))).epsilon(1e-5));
  CHECK(shape.tension_n == Approx(std::hypot(H, 300 + w * 100)).epsilon(1e-5));
}

TEST_CASE("a long cable tends to its critical angle") {
  // Where weight across the cable balances normal drag: w cos = q Cn d sin^2, whatever hangs on its end.
  const double speed = 3.0, k = 0.5 * 1025 * speed * speed * 1.2 * 0.01 / 2.0;
  const double cosine = (-1 + std::sqrt(1 + 4 * k * k)) / (2 * k);
  TowCable cable = kCable;
  cable.out_m = 3000;
  const TowShape longer = tow_shape(cable, kFish, speed);
  cable.out_m = 2900;
  const TowShape shorter = tow_shape(cable, kFish, speed);
  CHECK((longer.layback_m - shorter.layback_m) / 100 == Approx(cosine).epsilon(2e-3));
}

TEST_CASE("faster runs shallower and farther behind, more cable deeper") {
  TowShape before = tow_shape(kCable, kFish, 0.5);
  for (double speed = 1.0; speed < 5.0; speed += 0.5) {
    const TowShape now = tow_shape(kCable, kFish, speed);
    CHECK(now.depth_m < before.depth_m);
    CHECK(now.layback_m > before.layback_m);
    before = now;
  }
  TowCable longer = kCable;
  longer.out_m = 200;
  CHECK(tow_shape(longer, kFish, 2.0).depth_m > tow_shape(kCable, kFish, 2.0).depth_m);
}

TEST_CASE("on a straight course a body stays where it is towed, in a current too") {
  const Vec2 current(0.3, -0.2);
  Vec3 sheave(0, 0, 2);
  TowState fish = towed_behind(kCable, kFish, sheave, 0.0, 2.0);
  for (int i = 0; i < 3000; ++i) {
    sheave += 0.1 * Vec3(current.x(), 2.0 + current.y(), 0);
    fish = tow(kCable, kFish, fish, sheave, current, 20.0, 0.1);
  }
  const TowShape shape = tow_shape(kCable, kFish, 2.0);
  CHECK_THAT(fish.position_enu_m.z(), WithinAbs(2.0 - shape.depth_m, 1e-6));
  CHECK_THAT(sheave.y() - fish.position_enu_m.y(), WithinAbs(shape.layback_m, 1e-6));
  CHECK_THAT(fish.position_enu_m.x(), WithinAbs(sheave.x(), 1e-6));
}

TEST_CASE("on a circle a body runs inside on the tractrix' radius, and slower") {
  const double radius = 150, speed = 2.0;
  TowState fish = towed_behind(kCable, kFish, {radius, 0, 0}, 0.0, speed);
  double t = 0;
  for (; t < 1500; t += 0.05) {
    const double angle = speed * (t + 0.05) / radius;
    fish = tow(kCable, kFish, fish, {radius * std::cos(angle), radius * std::sin(angle), 0}, Vec2::Zero(), 20.0, 0.05);
  }
  const double inside = fish.position_enu_m.head<2>().norm();
  const double layback = tow_shape(kCable, kFish, fish.speed_mps).layback_m;
  CHECK(inside == Approx(std::sqrt(radius * radius - layback * layback)).epsilon(1e-3));
  CHECK(fish.speed_mps == Approx(speed * inside / radius).epsilon(1e-3));
  CHECK(-fish.position_enu_m.z() > tow_shape(kCable, kFish, speed).depth_m);  // slower, so deeper
}

TEST_CASE("when the ship stops the body sinks below her with its lag") {
  TowState fish = towed_behind(kCable, kFish, {0, 0, 0}, 0.0, 2.0);
  for (int i = 0; i < 4000; ++i) fish = tow(kCable, kFish, fish, Vec3::Zero(), Vec2::Zero(), 20.0, 0.1);
  CHECK_THAT(fish.position_enu_m.z(), WithinAbs(-100, 0.01));
  CHECK(fish.position_enu_m.head<2>().norm() < 1.0);
  CHECK(fish.speed_mps < 0.01);
}

TEST_CASE("a cable of no length is refused") {
  CHECK_THROWS_AS(tow_shape({0.0, 0.01, 1, 1, 0.01}, kFish, 1.0), std::invalid_argument);
  CHECK_THROWS_AS(tow_shape(kCable, kFish, -1.0), std::invalid_argument);
}

#include "kernels/vehicle/motion/current.h"

#include <catch2/catch.hpp>
#include <cmath>

using ensonify::frames::Vec2;
using ensonify::motion::Current;

namespace {

Current estuary() {
  Current current;
  current.profile = {{2.0, {0.4, 0.0}}, {12.0, {0.1, 0.2}}};
  current.streams = {{{0.3, 0.6}, 1.405189e-4, 0.7}};  // M2
  return current;
}

}  // namespace

TEST_CASE("the steady profile passes its knots, midway their mean, and is constant beyond") {
  Current current = estuary();
  current.streams.clear();
  CHECK(current.velocity_enu_mps(0.0, 5.0) == Vec2(0.4, 0.0));
  CHECK(current.velocity_enu_mps(2.0, 5.0) == Vec2(0.4, 0.0));
  CHECK((current.velocity_enu_mps(7.0, 5.0) - Vec2(0.25, 0.1)).norm() < 1e-12);
  CHECK((current.velocity_enu_mps(12.0, 5.0) - Vec2(0.1, 0.2)).norm() < 1e-12);
  CHECK(current.velocity_enu_mps(90.0, 5.0) == Vec2(0.1, 0.2));
  CHECK(Current{}.velocity_enu_mps(1.0, 1.0) == Vec2::Zero());
  CHECK(Current{}.none());
}

TEST_CASE("a profile stays within its knots between equal layers; uniform shear is linear") {
  Current layers, uniform;
  layers.profile = {{0, {0.5, -0.1}}, {10, {0.5, -0.1}}, {11, {0.1, 0.3}}, {50, {0.1, 0.3}}};
  uniform.profile = {{0, {0.0, 0.3}}, {5, {0.1, 0.2}}, {15, {0.3, 0.0}}, {25, {0.5, -0.2}}, {30, {0.6, -0.3}}};
  for (double depth_m = 0.0; depth_m <= 50.0; depth_m += 0.01) {
    const Vec2 at = layers.velocity_enu_mps(depth_m, 0.0);
    REQUIRE(at.x() <= 0.5 + 1e-12);
    REQUIRE(at.x() >= 0.1 - 1e-12);
    REQUIRE(at.y() >= -0.1 - 1e-12);
    REQUIRE(at.y() <= 0.3 + 1e-12);
    if (depth_m < 5.0 || depth_m > 25.0) continue;
    REQUIRE((uniform.velocity_enu_mps(depth_m, 0.0) - Vec2(0.02, -0.02) * depth_m - Vec2(0, 0.3)).norm() < 1e-12);
  }
}

TEST_CASE("what sinks through a profile is accelerated by the shear, at knots too") {
  Current current = estuary();
  current.profile.push_back({17.0, {-0.2, 0.4}});
  const double t = 4321.0, h = 1e-3, sinking_mps = 0.5;
  for (const double depth_m : {1.0, 2.0, 4.0, 7.0, 11.0, 12.0, 13.0, 17.0, 30.0}) {
    const auto then = [&](double s) { return current.velocity_enu_mps(depth_m + sinking_mps * s, t + s); };
    // By h times the jump of the curvature at a knot, 0.02 per m s, times the squared speed: 5e-6.
    const Vec2 rate = (then(h) - then(-h)) / (2 * h);
    CHECK((rate - current.acceleration_enu_mps2(depth_m, sinking_mps, t)).norm() < 5e-6);
  }
  CHECK(current.acceleration_enu_mps2(7.0, 1.0, t).norm() > 0.02);
}

TEST_CASE("drift and acceleration are integral and derivative of the velocity") {
  const Current current = estuary();
  const double t = 4321.0, h = 10.0;
  const Vec2 difference = (current.drift_enu_m(7, 0, t + h) - current.drift_enu_m(7, 0, t - h)) / (2 * h);
  CHECK((difference - current.velocity_enu_mps(7, t)).norm() < 1e-6);
  const Vec2 rate = (current.velocity_enu_mps(7, t + h) - current.velocity_enu_mps(7, t - h)) / (2 * h);
  CHECK((rate - current.acceleration_enu_mps2(7, 0, t)).norm() < 1e-9);
  CHECK((current.drift_enu_m(7, 0, 100) + current.drift_enu_m(7, 100, 200) - current.drift_enu_m(7, 0, 300)).norm() <
        1e-9);
}

TEST_CASE("after a tide the stream has carried nothing away") {
  Current current = estuary();
  current.profile.clear();
  const double period_s = 2 * std::acos(-1.0) / 1.405189e-4;
  CHECK(current.drift_enu_m(3, 100, period_s).norm() < 1e-6);
  CHECK(current.velocity_enu_mps(3, 0.7 / 1.405189e-4).norm() == Approx(std::hypot(0.3, 0.6)));
}

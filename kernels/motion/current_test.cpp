#include "kernels/motion/current.h"

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

TEST_CASE("the steady profile is met at its knots, straight between and constant beyond") {
  Current current = estuary();
  current.streams.clear();
  CHECK(current.velocity_enu_mps(0.0, 5.0) == Vec2(0.4, 0.0));
  CHECK((current.velocity_enu_mps(7.0, 5.0) - Vec2(0.25, 0.1)).norm() < 1e-12);
  CHECK(current.velocity_enu_mps(90.0, 5.0) == Vec2(0.1, 0.2));
  CHECK(Current{}.velocity_enu_mps(1.0, 1.0) == Vec2::Zero());
  CHECK(Current{}.none());
}

TEST_CASE("drift and acceleration are integral and derivative of the velocity") {
  const Current current = estuary();
  const double t = 4321.0, h = 10.0;
  const Vec2 difference = (current.drift_enu_m(7, 0, t + h) - current.drift_enu_m(7, 0, t - h)) / (2 * h);
  CHECK((difference - current.velocity_enu_mps(7, t)).norm() < 1e-6);
  const Vec2 rate = (current.velocity_enu_mps(7, t + h) - current.velocity_enu_mps(7, t - h)) / (2 * h);
  CHECK((rate - current.acceleration_enu_mps2(t)).norm() < 1e-9);
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

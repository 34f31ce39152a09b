#include <catch2/catch.hpp>
#include <numbers>

#include "kernels/instruments/sensors/scalar_sensor.h"

using namespace ensonify;
using namespace ensonify::sensors;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
const random::Stream kStream(1, "heading");

}  // namespace

TEST_CASE("deviation is semicircular and quadrantal by its coefficients") {
  const Deviation d{{0.01, 0.02, 0.03, 0.04, 0.05}};
  CHECK(d.at(0.0) == Approx(0.01 + 0.03 + 0.05));
  CHECK(d.at(90 * kDegree) == Approx(0.01 + 0.02 - 0.05));
  CHECK(d.at(45 * kDegree) == Approx(0.01 + (0.02 + 0.03) * std::sqrt(0.5) + 0.04));
  HeadingSensor compass({.kind = HeadingKind::kMagnetic, .deviation = d, .variation_error_rad = 0.005}, {}, kStream);
  CHECK(compass.measure(0.0, 0, 0, 0) == Approx(0.095));
}

TEST_CASE("a gyrocompass going north at 20 knots in 60 degrees points 2.5 degrees west") {
  // The rule of thumb v cos c / (5 pi cos latitude) degrees, v in knots: 20 / (5 pi / 2) = 2.55.
  CHECK(steaming_error_rad(20 * 1852 / 3600.0, 60 * kDegree) / kDegree == Approx(-2.55).epsilon(0.02));
  HeadingSensor gyro({.speed_corrected = false}, {}, kStream);
  CHECK(gyro.measure(1.0, 10.0, 1.0, 0) == Approx(1.0 + steaming_error_rad(10.0, 1.0)));
  CHECK(HeadingSensor({}, {}, kStream).measure(1.0, 10.0, 1.0, 0) == Approx(1.0));
}

TEST_CASE("a lagging compass crosses north without going round") {
  HeadingSensor compass({}, {.lag_s = 1.0}, kStream);
  compass.measure(359 * kDegree, 0, 0, 0);
  for (int i = 1; i <= 20; ++i) {
    const double reading = compass.measure(frames::wrap_two_pi((359 + i) * kDegree), 0, 0, 0.5);
    CHECK(std::abs(frames::wrap_pi(reading - (359 + i) * kDegree)) < 2.1 * kDegree);  // 2 degrees a second, lag 1 s
  }
}

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

TEST_CASE("each seed has a deviation curve of its own, as large as is stated") {
  const HeadingErrors errors{.kind = HeadingKind::kMagnetic, .deviation_sigma = {{0.01, 0.02, 0.03, 0.04, 0.05}}};
  constexpr int kSeeds = 2000, kHeadings = 8;
  for (int i = 0; i < kHeadings; ++i) {
    const double h = i * 0.1 * std::numbers::pi, s = std::sin(h), c = std::cos(h);
    double mean = 0.0, square = 0.0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      HeadingSensor compass(errors, {}, {seed, "heading"});
      const double error_rad = frames::wrap_pi(compass.measure(h, 0, 0, 0) - h);
      CHECK(frames::wrap_pi(compass.measure(h, 0, 0, 1) - h) == Approx(error_rad));  // drawn once
      mean += error_rad / kSeeds;
      square += error_rad * error_rad / kSeeds;
    }
    const double variance =
        1e-4 * (1 + 4 * s * s + 9 * c * c + 16 * std::pow(2 * s * c, 2) + 25 * std::pow(c * c - s * s, 2));
    // A mean square of 2000 Gaussians strays by sqrt(2 / 2000) = 3.2 %, a mean by 2.2 % of sigma: four times each.
    CHECK(square == Approx(variance).epsilon(0.126));
    CHECK(std::abs(mean) < 0.09 * std::sqrt(variance));
  }
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

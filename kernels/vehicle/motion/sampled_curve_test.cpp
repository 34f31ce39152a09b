#include "kernels/vehicle/motion/sampled_curve.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using Catch::WithinAbs;

using ensonify::motion::SampledCurve;

TEST_CASE("a parabola is followed exactly, whatever the distances of its samples") {
  SampledCurve curve;
  for (const double t : {-1.0, 0.0, 0.3, 1.7, 2.0, 4.5, 5.0}) curve.push(t, 3.0 - 2.0 * t + 0.7 * t * t);
  for (double t = 0.0; t <= 4.5; t += 0.01) {  // the pieces with neighbours on both sides
    REQUIRE_THAT(curve.at(t).value, WithinAbs(3.0 - 2.0 * t + 0.7 * t * t, 1e-12));
    REQUIRE_THAT(curve.at(t).rate, WithinAbs(-2.0 + 1.4 * t, 1e-12));
    REQUIRE_THAT(curve.at(t).acceleration, WithinAbs(1.4, 1e-10));
  }
}

TEST_CASE("a swell of ten samples a period is followed within 1 %, rates its derivatives") {
  constexpr double kOmega = 2.0 * 3.14159265358979;
  SampledCurve curve;
  for (int i = -3; i < 14; ++i) curve.push(0.1 * i, std::sin(kOmega * 0.1 * i));
  constexpr double kStep = 1e-5;
  for (double t = 0.0; t < 1.0; t += 0.0137) {
    // Slopes of parabolas err by (omega h)^2 / 6 = 6.6 % of omega, and a piece's middle by h / 4 of the slopes'
    // difference at its ends at most: 0.25 h omega 0.066 (2 sin(omega h / 2)) = 0.0064.
    REQUIRE_THAT(curve.at(t).value, WithinAbs(std::sin(kOmega * t), 0.0075));
    REQUIRE_THAT(curve.at(t).rate,
                 WithinAbs((curve.at(t + kStep).value - curve.at(t - kStep).value) / (2 * kStep), 1e-3));
  }
}

TEST_CASE("value and rate do not jump at samples; outside it goes straight on") {
  SampledCurve curve;
  const double values[] = {0.0, 1.0, -2.0, 5.0, 5.0};
  for (int i = 0; i < 5; ++i) curve.push(i, values[i]);
  for (int i = 1; i < 4; ++i) {
    CHECK_THAT(curve.at(i - 1e-9).value, WithinAbs(curve.at(i + 1e-9).value, 1e-7));
    CHECK_THAT(curve.at(i - 1e-9).rate, WithinAbs(curve.at(i + 1e-9).rate, 1e-6));
    CHECK(curve.at(i).value == Approx(values[i]));
  }
  CHECK(curve.at(6.0).value == 5.0);
  CHECK(curve.at(-1.0).value == -1.0);
}

TEST_CASE("late, double or non-finite samples are refused; dropped ones were not needed") {
  SampledCurve curve;
  CHECK(curve.push(1.0, 2.0));
  CHECK(curve.at(3.0).value == 2.0);
  CHECK_FALSE(curve.push(1.0, 3.0));
  CHECK_FALSE(curve.push(0.0, 3.0));
  CHECK_FALSE(curve.push(2.0, std::numeric_limits<double>::quiet_NaN()));
  for (int i = 2; i < 10; ++i) curve.push(i, i * i);
  const double before = curve.at(6.5).value;
  curve.forget_before(6.5);
  CHECK(curve.size() == 5);
  CHECK(curve.at(6.5).value == before);
}

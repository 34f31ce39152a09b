#include "kernels/vehicle/motion/gapped_curve.h"

#include <catch2/catch.hpp>
#include <limits>

using Catch::WithinAbs;
using ensonify::motion::GappedCurve;
using ensonify::motion::SampledCurve;

TEST_CASE("without a gap it is the sampled curve") {
  GappedCurve gapped({.gap_s = 1.5, .goes_on_s = 2.0});
  SampledCurve plain;
  for (int i = 0; i < 6; ++i) {
    gapped.push(i, i * i * (i % 2));
    plain.push(i, i * i * (i % 2));
  }
  for (double t = 0.0; t <= 7.0; t += 0.1) {  // beyond the end for as long as it goes on
    REQUIRE(gapped.at(t).value == plain.at(t).value);
    REQUIRE(gapped.at(t).rate == plain.at(t).rate);
  }
}

TEST_CASE("behind a stretch it goes on for its time, then rests until the next one begins") {
  GappedCurve curve({.gap_s = 1.5, .goes_on_s = 2.0});
  for (const double t : {0.0, 1.0, 2.0}) curve.push(t, 3.0 * t);
  for (const double t : {60.0, 61.0}) curve.push(t, 100.0 + t);
  CHECK_THAT(curve.at(4.0).value, WithinAbs(12.0, 1e-12));
  CHECK_THAT(curve.at(4.0).rate, WithinAbs(3.0, 1e-12));
  for (const double t : {4.001, 30.0, 59.999}) {
    CHECK_THAT(curve.at(t).value, WithinAbs(12.0, 1e-12));
    CHECK(curve.at(t).rate == 0.0);
  }
  CHECK_THAT(curve.at(60.5).value, WithinAbs(160.5, 1e-12));
}

TEST_CASE("a value that must not go on never leaves its samples' range") {
  GappedCurve curve({.gap_s = 1.0, .goes_on_s = 0.0});
  for (int i = 0; i < 20; ++i) curve.push(0.1 * i, 0.1 * i);          // rises by 1 a second
  for (int i = 0; i < 20; ++i) curve.push(100.0 + 0.1 * i, 0.1 * i);  // and again, after a gap
  for (double t = -5.0; t < 110.0; t += 0.013) {
    REQUIRE(curve.at(t).value >= -1e-12);
    REQUIRE(curve.at(t).value <= 1.9 + 1e-12);
  }
}

TEST_CASE("an interruption begins a stretch without a gap") {
  GappedCurve curve({.gap_s = 5.0, .goes_on_s = 1.0});
  curve.push(0.0, 0.0);
  curve.push(1.0, 1.0);
  curve.interrupt();
  curve.push(2.0, 50e3);
  curve.push(3.0, 50e3);
  CHECK_THAT(curve.at(1.999).value, WithinAbs(1.999, 1e-12));
  CHECK(curve.at(2.0).value == 50e3);
  curve.forget_before(2.5);
  CHECK(curve.oldest_s() == 2.0);
}

TEST_CASE("samples out of order or without a number are not taken") {
  GappedCurve curve({.gap_s = 1.0});
  CHECK(curve.push(1.0, 1.0));
  CHECK_FALSE(curve.push(1.0, 2.0));
  CHECK_FALSE(curve.push(0.5, 2.0));
  CHECK_FALSE(curve.push(2.0, std::numeric_limits<double>::quiet_NaN()));
  CHECK(curve.newest() == 1.0);
}

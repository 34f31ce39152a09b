#include "kernels/instruments/sensors/scalar_sensor.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace ensonify;
using namespace ensonify::sensors;
using Catch::WithinAbs;

TEST_CASE("a scalar sensor's noise and drawn errors have their stated spread") {
  // 4000 draws each: a standard deviation strays by 1.1 %; four times that is allowed.
  double white = 0, bias = 0, scale = 0, wander = 0;
  ScalarSensor noisy({.white = 0.5}, random::Stream(1, "w"));
  for (std::uint64_t i = 0; i < 4000; ++i) {
    white += std::pow(noisy.measure(10.0, 1.0) - 10.0, 2);
    bias += std::pow(ScalarSensor({.bias_sigma = 0.5}, random::Stream(i, "b")).measure(10.0, 1.0) - 10.0, 2);
    scale += std::pow(ScalarSensor({.scale = 0.05}, random::Stream(i, "s")).measure(10.0, 1.0) - 10.0, 2);
    wander += std::pow(ScalarSensor({.wander = 0.5}, random::Stream(i, "g")).measure(10.0, 1.0) - 10.0, 2);
  }
  for (const double sum : {white, bias, scale, wander}) CHECK(std::sqrt(sum / 4000) == Approx(0.5).epsilon(0.045));
}

TEST_CASE("a wandering error forgets itself as exp(-lag / T)") {
  ScalarSensor sensor({.wander = 1.0, .wander_s = 10.0}, random::Stream(2, "g"));
  double last = sensor.measure(0.0, 0.0), product = 0.0;
  constexpr int kCount = 20000;  // lag-one correlation strays by sqrt((1 - 0.61^2) / 20000) = 0.6 %
  for (int i = 0; i < kCount; ++i) {
    const double next = sensor.measure(0.0, 5.0);
    product += last * next;
    last = next;
  }
  CHECK_THAT(product / kCount, WithinAbs(std::exp(-0.5), 0.03));
}

TEST_CASE("a lagging sensor follows a step exponentially, a ramp late by rate times lag") {
  ScalarSensor step({.lag_s = 2.0}, random::Stream(1, "l"));
  step.measure(0.0, 0.0);
  step.measure(1.0, 1e-9);
  CHECK(step.measure(1.0, 3.0) == Approx(1.0 - std::exp(-1.5)).epsilon(1e-6));
  ScalarSensor ramp({.lag_s = 2.0}, random::Stream(1, "l"));
  double reading = ramp.measure(0.0, 0.0);
  for (int i = 1; i <= 100; ++i) reading = ramp.measure(0.5 * i, 1.0);
  CHECK(reading == Approx(50.0 - 0.5 * 2.0).epsilon(1e-9));
}

TEST_CASE("readings are multiples of the resolution, biased as stated") {
  ScalarSensor sensor({.bias = 0.26, .resolution = 0.1}, random::Stream(1, "r"));
  CHECK(sensor.measure(1.0, 1.0) == Approx(1.3));
}

TEST_CASE("an altimeter answers within its range, and fails as often as stated") {
  RangeSensor sensor({.dropout = 0.25}, {}, random::Stream(1, "altimeter"));
  int answers = 0;
  for (int i = 0; i < 4000; ++i) {
    if (const auto range = sensor.measure(12.5, 0.1)) {
      REQUIRE(*range == 12.5);
      ++answers;
    }
  }
  CHECK_THAT(answers / 4000.0, WithinAbs(0.75, 0.028));  // four times sqrt(0.75 * 0.25 / 4000)
  RangeSensor sure({}, {}, random::Stream(1, "altimeter"));
  CHECK(!sure.measure(0.2, 0.1));
  CHECK(!sure.measure(101.0, 0.1));
  CHECK(!sure.measure(std::nullopt, 0.1));
  CHECK(sure.measure(100.0, 0.1));
}

#include "kernels/instruments/sensors/instrument_clock.h"

#include <catch2/catch.hpp>

using namespace ensonify::sensors;

TEST_CASE("a free clock has its offset and drift, a locked one its residual") {
  CHECK(InstrumentClock{.offset_s = 0.5, .drift_ppm = 20, .locked = false}.error_s(1000) == Approx(0.52));
  CHECK(InstrumentClock{.offset_s = 0.5, .drift_ppm = 20, .residual_s = 1e-4}.error_s(1000) == Approx(1e-4));
}

TEST_CASE("without the pulse the clock drifts from there; with it the clock is right again") {
  const InstrumentClock clock{.drift_ppm = 50, .unlocked_s = {100, 200, 200, 300, 500, 600}};
  CHECK(clock.error_s(99) == 0.0);
  CHECK(clock.error_s(150) == Approx(50e-6 * 50));
  CHECK(clock.error_s(299) == Approx(50e-6 * 199));  // spans that touch are one
  CHECK(clock.error_s(300) == 0.0);
  CHECK(clock.error_s(550) == Approx(50e-6 * 50));
}

TEST_CASE("a stamp is of the measurement or of the output") {
  const InstrumentClock clock{.offset_s = 1.0, .locked = false};
  CHECK(clock.stamp_s(10.0, 0.25, Stamping::kMeasurement) == Approx(11.0));
  CHECK(clock.stamp_s(10.0, 0.25, Stamping::kOutput) == Approx(11.25));
}

TEST_CASE("spans hold their start and not their end") {
  const std::vector<double> spans{1, 2, 5, 6};
  CHECK(within(spans, 1.0));
  CHECK(!within(spans, 2.0));
  CHECK(!within(spans, 4.0));
  CHECK(within(spans, 5.5));
}

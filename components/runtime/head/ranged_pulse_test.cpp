#include "components/runtime/head/ranged_pulse.h"

#include <catch2/catch.hpp>

using namespace ensonify;

TEST_CASE("near, a chirp keeps its band; far, it sweeps what the samples can show") {
  const PulseDesign design{.chirp = true, .length_s = 100e-6, .bandwidth_hz = 188e3, .most_samples = 2000};
  const RangedPulse near = pulse_at(design, 3.0, 1500.0);  // 4 ms
  CHECK(near.band_hz == 188e3);
  CHECK(near.length_s == 100e-6);
  CHECK(near.sampling.period_s == Approx(0.5 / 188e3));
  CHECK(near.sampling.count == 1504);                       // 4 ms of them
  const RangedPulse far = pulse_at(design, 120.0, 1500.0);  // 160 ms
  CHECK(far.band_hz == Approx(2000 / 0.16 / 2));
  CHECK(far.length_s == Approx(4 / far.band_hz));  // else it were no sweep
  CHECK(far.sampling.count == 2000);
  CHECK(far.sampling.count * far.sampling.period_s == Approx(0.16));
  CHECK_NOTHROW(echo::SampledPulse(echo_pulse(design, far), far.sampling.period_s));
}

TEST_CASE("a tone lasts as long as two of its samples") {
  const PulseDesign design{.length_s = 20e-6, .most_samples = 1200};
  CHECK(pulse_at(design, 3.0, 1500.0).length_s == Approx(20e-6));  // 400 samples of 10 us
  const RangedPulse far = pulse_at(design, 50.0, 1500.0);
  CHECK(far.sampling.count == 1200);
  CHECK(far.length_s == Approx(2 * far.sampling.period_s));
  CHECK(far.listening_s() == Approx(2 * 50.0 / 1500.0 + far.length_s));
  CHECK_NOTHROW(echo::SampledPulse(echo_pulse(design, far), far.sampling.period_s));
}

TEST_CASE("the window of a chirp's filter is the design's") {
  PulseDesign design{.chirp = true, .length_s = 1e-3, .bandwidth_hz = 100e3};
  const auto loss_db = [&](echo::Window window) {
    design.window = window;
    return 20.0 - echo_pulse(design, pulse_at(design, 3.0, 1500.0)).processing_gain_db;  // of B T = 100
  };
  // Mean square over squared mean of the weights [Harris1978]; the sweep's 100 samples of them leave 0.02 dB.
  CHECK(loss_db(echo::Window::kNone) == Approx(0.0).margin(0.02));
  CHECK(loss_db(echo::Window::kHann) == Approx(1.76).margin(0.02));
  CHECK(loss_db(echo::Window::kHamming) == Approx(1.34).margin(0.02));
}

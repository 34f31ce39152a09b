#include "components/sonar/ranged_pulse.h"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace ensonify;
using Catch::WithinAbs;

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
  CHECK(far.reception_s() == Approx(2 * 50.0 / 1500.0 + far.length_s));
  CHECK_NOTHROW(echo::SampledPulse(echo_pulse(design, far), far.sampling.period_s));
}

TEST_CASE("a held tone keeps its length where the samples reach, a held chirp its band too") {
  const PulseDesign tone{.length_s = 20e-6, .most_samples = 1200};
  CHECK(pulse_at(tone, 3.0, 1500.0, 100e-6).length_s == Approx(100e-6));
  CHECK(pulse_at(tone, 3.0, 1500.0, 100e-6).sampling.period_s == Approx(50e-6));  // two samples of it
  CHECK(pulse_at(tone, 20.0, 1500.0, 100e-6).length_s == Approx(100e-6));
  CHECK(pulse_at(tone, 50.0, 1500.0, 100e-6).length_s == Approx(2 * 66.667e-3 / 1200));  // longer: 111 us
  CHECK(pulse_at(tone, 50.0, 1500.0, 0.0) == pulse_at(tone, 50.0, 1500.0));

  const PulseDesign chirp{.chirp = true, .length_s = 100e-6, .bandwidth_hz = 188e3, .most_samples = 2000};
  CHECK(pulse_at(chirp, 3.0, 1500.0, 1e-3).length_s == 1e-3);
  CHECK(pulse_at(chirp, 3.0, 1500.0, 1e-3).band_hz == 188e3);
  CHECK(pulse_at(chirp, 120.0, 1500.0, 100e-6).length_s == Approx(4 / 6250.0));  // of B T = 4
}

TEST_CASE("commands stay within the design's pulses, with a remark if the range needs more") {
  const PulseDesign tone{.length_s = 20e-6, .longest_s = 1e-3, .most_samples = 1200};
  SettingLimits limits;
  allow_held_pulses(tone, 1500.0, limits);
  CHECK(limits["pulse_length_s"].least == 20e-6);
  CHECK(limits["pulse_length_s"].most == 1e-3);
  CHECK(limits["pulse_length_s"].chosen);
  CHECK(limits.shortest_pulse_s(3.0) == Approx(20e-6));
  CHECK(limits.shortest_pulse_s(50.0) == Approx(111.11e-6).epsilon(1e-4));
}

TEST_CASE("no pulse at any range is received for longer than the longest") {
  for (const bool chirp : {false, true}) {
    const PulseDesign design{
        .chirp = chirp, .length_s = 20e-6, .longest_s = 5e-3, .bandwidth_hz = 188e3, .most_samples = 1200};
    const double longest_s = longest_reception_s(design, 50.0, 1500.0);
    double found_s = 0.0;
    for (double range_m = 0.5; range_m <= 50.0; range_m += 0.37) {
      for (double held_s = 20e-6; held_s <= 5e-3; held_s *= 1.17) {
        found_s = std::max(found_s, pulse_at(design, range_m, 1500.0, held_s).reception_s());
      }
    }
    CHECK(found_s <= longest_s);
    CHECK(found_s > 0.9 * longest_s);
  }
}

TEST_CASE("the window of a chirp's filter is the design's") {
  PulseDesign design{.chirp = true, .length_s = 1e-3, .bandwidth_hz = 100e3};
  const auto loss_db = [&](echo::Window window) {
    design.window = window;
    return 20.0 - echo_pulse(design, pulse_at(design, 3.0, 1500.0)).processing_gain_db;  // of B T = 100
  };
  // Mean square over squared mean of the weights [Harris1978]; the sweep's 100 samples of them leave 0.02 dB.
  CHECK_THAT(loss_db(echo::Window::kNone), WithinAbs(0.0, 0.02));
  CHECK_THAT(loss_db(echo::Window::kHann), WithinAbs(1.76, 0.02));
  CHECK_THAT(loss_db(echo::Window::kHamming), WithinAbs(1.34, 0.02));
}

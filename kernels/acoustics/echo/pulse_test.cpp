#include "kernels/acoustics/echo/pulse.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace ensonify::echo;
using Catch::WithinAbs;

/// Where the envelope falls to half power right of its peak.
static double half_power_s(const Pulse& pulse) {
  double t = 0.0;
  while (pulse.at(t) > std::sqrt(0.5)) t += 1e-3 / pulse.bandwidth_hz;
  return t;
}

/// The highest side lobe right of the first dip, dB.
static double side_lobe_db(const Pulse& pulse) {
  const double step = 5e-3 / pulse.bandwidth_hz;
  double t = 0.0;
  while (std::abs(pulse.at(t + step)) < std::abs(pulse.at(t))) t += step;
  double highest = 0.0;
  for (; t < pulse.end_s(); t += step) highest = std::max(highest, std::abs(pulse.at(t)));
  return 20 * std::log10(highest);
}

TEST_CASE("a rectangular pulse is 1 for its length, and a tapered one brings less energy") {
  const Pulse tone = rectangular_pulse(100e-6);
  CHECK(tone.at(-1e-9) == 0.0);
  CHECK(tone.at(0.0) == 1.0);
  CHECK(tone.at(99.9e-6) == 1.0);
  CHECK(tone.at(100e-6) == 0.0);
  CHECK(tone.equivalent_length_s() == Approx(100e-6));
  CHECK(tone.noise_bandwidth_hz == Approx(10e3));
  // Tukey's window of taper a has energy 1 - 5 a / 8; Hann's (a = 1) is 3/8.
  CHECK(tapered_pulse(100e-6, 0.4).equivalent_length_s() == Approx(75e-6).epsilon(1e-4));
  CHECK(tapered_pulse(100e-6, 1.0).equivalent_length_s() == Approx(37.5e-6).epsilon(1e-4));
  CHECK(tapered_pulse(100e-6, 0.0).equivalent_length_s() == Approx(100e-6));
}

TEST_CASE("a compressed chirp is sinc(B t) wide, with its side lobe and gain") {
  // 1 ms over 100 kHz. sin(pi B t (1 - |t|/T)) / (pi B t) [Klauder1960] differs from sinc by 1 % at the side lobe,
  // which is of the other sign.
  const Pulse chirp = compressed_chirp(1e-3, 100e3);
  CHECK(chirp.at(0.0) == Approx(1.0));
  CHECK(2 * half_power_s(chirp) == Approx(0.886 / 100e3).epsilon(0.01));
  CHECK_THAT(side_lobe_db(chirp), WithinAbs(-13.26, 0.15));
  CHECK_THAT(chirp.processing_gain_db, WithinAbs(10 * std::log10(100.0), 1e-6));
  CHECK(chirp.noise_bandwidth_hz == Approx(1e3));
  CHECK(chirp.equivalent_length_s() == Approx(1 / 100e3).epsilon(0.02));  // the tails below -40 dB hold under 1 %
  for (const double t : {3.3e-6, 14.5e-6, 37e-6}) {
    const double x = 3.14159265358979 * 100e3 * t;
    CHECK_THAT(chirp.at(t), WithinAbs(std::sin(x * (1 - t / 1e-3)) / x, 2e-3));  // the table's steps
  }
}

TEST_CASE("windows lower a chirp's side lobes as they lower a line array's") {
  // Their Fourier transforms' [Harris1978]: Hann -31.5, Hamming -42.7, Blackman -58.1 dB; the ripple of a sweep of 400
  // turns adds some.
  CHECK_THAT(side_lobe_db(compressed_chirp(4e-3, 100e3, Window::kHann, 60)), WithinAbs(-31.5, 0.5));
  CHECK_THAT(side_lobe_db(compressed_chirp(4e-3, 100e3, Window::kHamming, 60)), WithinAbs(-42.7, 1.0));
  const Pulse hann = compressed_chirp(4e-3, 100e3, Window::kHann);
  CHECK_THAT(hann.processing_gain_db, WithinAbs(10 * std::log10(400.0) - 1.76, 0.01));  // mean square over squared mean
  CHECK(2 * half_power_s(hann) == Approx(1.44 / 100e3).epsilon(0.01));
}

TEST_CASE("two points are two at 1.2 and one at 0.7 of the resolution") {
  // Peak over the middle, of the sum of powers. Two of sinc^2 1.2 widths apart: 2 sinc^2(0.6) is 3.0 dB down.
  const auto dip_db = [](const Pulse& pulse, double apart_s) {
    double peak = 0.0;
    for (double t = -apart_s; t < apart_s + pulse.duration_s; t += 0.01 / pulse.bandwidth_hz) {
      peak = std::max(peak, std::pow(pulse.at(t), 2) + std::pow(pulse.at(t - apart_s), 2));
    }
    const double middle = 0.5 * (apart_s + (pulse.start_s < 0 ? 0.0 : pulse.duration_s));
    const double between = std::pow(pulse.at(middle), 2) + std::pow(pulse.at(middle - apart_s), 2);
    return 10 * std::log10(peak / std::max(between, 1e-12));
  };
  CHECK(dip_db(rectangular_pulse(100e-6), 120e-6) > 3.0);
  CHECK(dip_db(rectangular_pulse(100e-6), 70e-6) < 0.01);  // the overlap is the peak
  CHECK(dip_db(compressed_chirp(1e-3, 100e3), 1.2 / 100e3) > 2.9);
  CHECK(dip_db(compressed_chirp(1e-3, 100e3), 0.7 / 100e3) < 0.1);
}

TEST_CASE("samples of a pulse carry its energy wherever it arrives") {
  for (const Pulse& pulse : {rectangular_pulse(100e-6), tapered_pulse(100e-6, 0.5), compressed_chirp(1e-3, 20e3)}) {
    const SampledPulse sampled(pulse, 20e-6);
    double energy = 0.0;
    for (int phase = 0; phase < SampledPulse::kPhases; ++phase) {
      for (const float e : sampled.row(phase)) energy += e * e * 20e-6 / SampledPulse::kPhases;
    }
    CHECK(energy == Approx(pulse.equivalent_length_s()).epsilon(0.01));
  }
  const SampledPulse sampled(rectangular_pulse(100e-6), 20e-6);
  const auto place = sampled.place(7.25);  // sample 8 is three quarters of a period after the arrival
  CHECK(place.first == 8);
  CHECK(place.phase == 96);
}

TEST_CASE("what cannot be is said") {
  CHECK_THROWS_WITH(rectangular_pulse(0.0), "the length of a pulse is 0.000000: it must be positive");
  CHECK_THROWS_WITH(SampledPulse(rectangular_pulse(100e-6), 60e-6),
                    "a sample period of 60.000000 us does not suit the pulse: at most 50.000000 us are allowed");
  CHECK_THROWS_AS(compressed_chirp(100e-6, 20e3), std::invalid_argument);
  CHECK_THROWS_AS(tapered_pulse(1e-4, 1.5), std::invalid_argument);
}

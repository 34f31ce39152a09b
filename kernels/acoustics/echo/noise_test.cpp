#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "kernels/acoustics/echo/aperture.h"
#include "kernels/acoustics/echo/line_receiver.h"

using namespace ensonify::echo;
using Catch::WithinAbs;
using ensonify::random::Stream;

static const Pulse kPulse = rectangular_pulse(100e-6);

/// Noise of 40 dB, of so many samples in a pulse.
static Image noise(double samples_per_pulse, int beams, int samples, std::uint64_t ping = 3,
                   const Pulse& pulse = kPulse) {
  Image image{beams, samples, std::vector<std::complex<float>>(static_cast<std::size_t>(beams) * samples)};
  RowBackground background;
  background.add_noise(40.0, SampledPulse(pulse, 1.0 / (samples_per_pulse * pulse.bandwidth_hz)), ping,
                       Stream{1, "noise"}, image);
  return image;
}

/// Mean of p(k) conj(p(k - lag)) over that of |p|^2, real part.
static double correlation(const Image& image, int lag) {
  double product = 0.0, power = 0.0;
  for (int b = 0; b < image.beams; ++b) {
    for (int k = lag; k < image.samples; ++k) {
      product += double((image.row(b)[k] * std::conj(image.row(b)[k - lag])).real());
      power += double(std::norm(image.row(b)[k]));
    }
  }
  return product / power;
}

TEST_CASE("noise has its level, exponential power, and no correlation of beams or of pulses") {
  const Image image = noise(2.0, 20, 10002);
  // Power is exponential: with 100,000 pulses sd of its mean 0.35 %, of its mean square 1.5 %; 4 sd.
  const double n = 20 * 10002;
  double power = 0, square = 0, parts = 0, across = 0;
  for (int b = 0; b < 20; ++b)
    for (int k = 0; k < 10002; ++k) {
      const auto p = image.row(b)[k];
      power += std::norm(p);
      square += std::norm(p) * std::norm(p);
      parts += p.real() * p.imag();
      if (b > 0) across += (p * std::conj(image.row(b - 1)[k])).real();
    }
  CHECK(power / n == Approx(1e4).epsilon(0.015));
  CHECK(square / n == Approx(2e8).epsilon(0.06));
  CHECK(std::abs(parts / n) < 0.013 * 0.5e4);
  CHECK(std::abs(across / n) < 0.013 * 1e4);
  CHECK(std::abs(correlation(image, 2)) < 0.013);
}

TEST_CASE("noise is correlated as the echo's filter has it, however densely it is sampled") {
  // A tone's filter is as long as the tone: a triangle. 20,000 pulses or more: sd 0.7 %, of a correlation; 4 sd.
  for (const double per_pulse : {2.0, 2.5, 4.0, 8.0, 20.0}) {
    const Image image = noise(per_pulse, 20, static_cast<int>(1000 * per_pulse));
    INFO(per_pulse << " samples in a pulse");
    CHECK(correlation(image, 0) == 1.0);
    for (int lag = 1; lag < 2 * per_pulse; ++lag) {
      // Of 2.5 samples the last is there half of the time: 0.07 off.
      const double margin = per_pulse == std::floor(per_pulse) ? 0.03 : 0.1;
      CHECK_THAT(correlation(image, lag), WithinAbs(std::max(0.0, 1.0 - lag / per_pulse), margin));
    }
  }
}

TEST_CASE("noise of a pulse's samples together is equally strong, however densely it is sampled") {
  // Mean square of the mean over a pulse: 2/3 of that of a sample, from (2 n^2 + 1) / (3 n^2) on.
  for (const int per_pulse : {2, 4, 8, 20}) {
    const Image image = noise(per_pulse, 20, 2000 * per_pulse);
    double square = 0.0;
    for (int b = 0; b < 20; ++b) {
      for (int k = 0; k + per_pulse <= image.samples; k += per_pulse) {
        std::complex<float> sum;
        for (int i = 0; i < per_pulse; ++i) sum += image.row(b)[k + i];
        square += double(std::norm(sum)) / (per_pulse * per_pulse) / (20 * 2000);
      }
    }
    CHECK(square / 1e4 == Approx((2.0 * per_pulse * per_pulse + 1.0) / (3.0 * per_pulse * per_pulse)).epsilon(0.03));
  }
}

TEST_CASE("a filter's noise has the bandwidth that its level is reckoned with") {
  // White noise of density 1 behind a filter of the response r: power over density at 0 Hz is sum r^2 / (sum r)^2 a
  // period. A tone's filter passes 1 / length.
  for (const double per_pulse : {2.0, 5.0, 20.0}) {
    const SampledPulse sampled(kPulse, kPulse.duration_s / per_pulse);
    double sum = 0.0, energy = 0.0;
    for (const float r : sampled.response()) sum += double(r), energy += double(r) * double(r);
    CHECK(energy == Approx(1.0).epsilon(1e-5));
    CHECK_THAT(10 * std::log10(energy / (sum * sum) * per_pulse / kPulse.duration_s / kPulse.noise_bandwidth_hz),
               WithinAbs(0.0, 0.05));
  }
}

TEST_CASE("a chirp's noise is white over its band: independent 1 / B apart, alike between") {
  // sinc of the band, but for the tail that the filter's response is cut at (40 dB down) and its sign there.
  const Pulse chirp = compressed_chirp(2e-3, 50e3);
  const Image image = noise(8.0, 20, 8000, 3, chirp);
  CHECK_THAT(correlation(image, 4), WithinAbs(2.0 / std::numbers::pi, 0.06));
  CHECK(std::abs(correlation(image, 8)) < 0.1);
  CHECK(std::abs(correlation(image, 16)) < 0.1);
}

TEST_CASE("elements of a line have noise of the same colour as apertures") {
  const Stream ambient{1, "ambient"}, electronic{1, "electronic"};
  for (const double spacing : {0.5, 0.35}) {  // independent elements, and a field
    const LineReceiver receiver({24, spacing});
    LineReceiver::Memory memory;
    std::vector<Image> images(1);
    const std::vector<WantedImage> wanted{WantedImage(beam_weights(std::vector<double>(24, 1.0)))};
    const std::vector<float> beams{-0.6F, -0.2F, 0.2F, 0.6F};
    const SampledPulse pulse(kPulse, 25e-6);
    receiver.form({{}, pulse, {0.0, 25e-6, 40000}, {1, 1.0, &ambient, 0.1, &electronic, {}, nullptr}}, beams, wanted,
                  images, memory);
    for (int lag = 1; lag < 8; ++lag) {
      CHECK_THAT(correlation(images[0], lag), WithinAbs(std::max(0.0, 1.0 - 0.25 * lag), 0.03));
    }
  }
}

TEST_CASE("noise is a function of ping, beam and sample, for any number of threads") {
  const auto limited = [](std::uint64_t ping, int beams, int samples, std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return noise(2.0, beams, samples, ping);
  };
  const Image a = limited(3, 8, 100, 1);
  CHECK(a.envelope_upa == limited(3, 8, 100, 2).envelope_upa);
  CHECK(a.row(5)[42] == limited(3, 6, 43, 1).row(5)[42]);
  CHECK(a.row(5)[42] != limited(4, 8, 100, 1).row(5)[42]);
}

TEST_CASE("no noise is no noise") {
  Image image{2, 10, std::vector<std::complex<float>>(20)};
  RowBackground background;
  background.add_noise(-std::numeric_limits<double>::infinity(), SampledPulse(kPulse, 50e-6), 0, Stream{1, "noise"},
                       image);
  for (const auto p : image.envelope_upa) CHECK(p == std::complex<float>{});
}

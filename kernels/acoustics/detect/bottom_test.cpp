#include "kernels/acoustics/detect/bottom.h"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernels/acoustics/detect/testing/plane_echo.h"
#include "kernels/base/random/stream.h"
#include "kernels/base/testing/allocations.h"

using namespace ensonify;
using namespace ensonify::detect;
using Catch::WithinAbs;

namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

/// One beam of steady noise of 0 dB with pulses of four samples, sampled every 50 us from 10 ms on.
struct Pulses {
  std::vector<float> amplitude = std::vector<float>(1000, 1.0F);
  Settings settings{.pulse_length_s = 200e-6};

  Pulses& add(int first, float pulse_amplitude) {
    for (int k = first; k < first + 4; ++k) amplitude[static_cast<std::size_t>(k)] = pulse_amplitude;
    return *this;
  }
  std::vector<Detection> detect() const {
    std::vector<Detection> detections;
    const std::vector<float> nadir{0.0F};
    detect_bottom(settings, nadir, {1, 1000, 0.01, 50e-6, amplitude}, detections);
    return detections;
  }
};

/// A level plane in beams of -70 to 70 degrees.
PlaneSurvey survey() {
  PlaneSurvey plane;
  for (int deg = -70; deg <= 70; deg += 10) plane.sin_beams.push_back(static_cast<float>(std::sin(deg * kDeg)));
  return plane;
}

}  // namespace

TEST_CASE("a lone pulse is found at its start, to a fraction of a sample") {
  const auto found = Pulses().add(400, 100.0F).detect();
  REQUIRE(found.size() == 1);
  REQUIRE(found[0].valid);
  CHECK(found[0].flags == 0);
  // Samples 400..403 cover a pulse that began between 399 and 400.
  CHECK_THAT(found[0].two_way_s, WithinAbs(0.01 + 399.5 * 50e-6, 2e-6));
  CHECK_THAT(found[0].echo_energy_db, WithinAbs(10 * std::log10(1e4 * 200e-6), 0.05));
  CHECK(found[0].phase_weight == 0.0F);
  // A sharp pulse in weak noise: what is left is the sampling, period / sqrt(12), as a range at 1500 m/s.
  CHECK(found[0].range_sd_m == Approx(750 * 50e-6 / std::sqrt(12)).epsilon(0.1));
  CHECK_THAT(found[0].quality, WithinAbs(-std::log10(50e-6 / std::sqrt(12) / found[0].two_way_s), 0.05));
  CHECK(found[0].snippet_first <= 400);
  CHECK(found[0].snippet_first + found[0].snippet_count >= 404);
}

TEST_CASE("flags say why a beam has no bottom") {
  CHECK(Pulses().add(400, 3.0F).detect()[0].flags == kLowSnr);
  CHECK_THAT(Pulses().add(400, 3.0F).detect()[0].snr_db, WithinAbs(10 * std::log10(9 * std::numbers::ln2), 0.01));

  Pulses early;
  early.add(400, 100.0F);
  early.settings.gates = {.max_range_m = 20.0};  // it comes at 30 ms, 22.5 m
  CHECK(early.detect()[0].flags == (kLowSnr | kOutOfGate));
  early.settings.gates = {.min_depth_m = 25.0};
  CHECK(early.detect()[0].flags == (kLowSnr | kOutOfGate));
  early.settings.gates = {.min_range_m = 22.0, .max_depth_m = 23.0};
  CHECK(early.detect()[0].valid);

  const auto late = Pulses().add(996, 100.0F).detect()[0];
  CHECK((late.flags & kCutOff) != 0);
  CHECK_FALSE(late.valid);

  Pulses silent;
  std::fill(silent.amplitude.begin(), silent.amplitude.end(), 0.0F);
  CHECK(silent.detect()[0].flags == kNoSignal);
  CHECK_FALSE(silent.detect()[0].valid);
}

TEST_CASE("several detections come in order of time, and the weaker say so") {
  Pulses three;
  three.add(700, 100.0F).add(300, 60.0F).add(500, 20.0F);  // 0, -4.4 and -14 dB
  three.settings.max_detections = 4;
  auto found = three.detect();
  REQUIRE(found.size() == 4);
  CHECK_THAT(found[0].two_way_s, WithinAbs(0.01 + 299.5 * 50e-6, 2e-6));
  CHECK(found[0].flags == kNotStrongest);
  CHECK(found[0].valid);
  CHECK_THAT(found[1].two_way_s, WithinAbs(0.01 + 699.5 * 50e-6, 2e-6));
  CHECK(found[1].flags == 0);
  CHECK_FALSE(found[2].valid);  // 14 dB below the strongest is more than second_within_db
  CHECK(found[2].flags == kNoSignal);

  three.settings.second_within_db = 15.0;
  found = three.detect();
  CHECK_THAT(found[1].two_way_s, WithinAbs(0.01 + 499.5 * 50e-6, 2e-6));
  CHECK(found[2].valid);
  three.settings.max_detections = 1;
  found = three.detect();
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0].two_way_s, WithinAbs(0.01 + 699.5 * 50e-6, 2e-6));
}

TEST_CASE("a plane seabed is one detection per beam, however many are allowed") {
  const auto plane = survey();
  auto settings = settings_for(plane);
  settings.max_detections = 4;
  PlaneEcho echo;
  std::vector<Detection> found;
  int further = 0, lone = 0;
  for (std::uint64_t ping = 0; ping < 10; ++ping) {
    echo.ping(plane, {3, "plane"}, ping);
    detect_bottom(settings, plane.sin_beams, echo.amplitudes(plane), echo.halves(), found);
    for (std::size_t i = 0; i < found.size(); ++i) (i % 4 == 0 ? lone : further) += found[i].valid;
  }
  // The strongest fades below the gate of 13 dB in some 10 % of the pings near nadir, where a beam receives one pulse.
  // A sidelobe (-13 dB, outside the snippet) must fade up by 3 dB or more to count; seldom.
  CHECK(lone > 130);
  CHECK(further <= 15);
}

TEST_CASE("noise passes the gate as often as it should") {
  // One sample per pulse, 250 samples: a beam alarms with probability 1 - (1 - exp(-G))^250. The noise estimate (256
  // samples, sd 9 % of the power) spreads G; averaged over that spread at 9 dB (G = 7.94) the rate is 0.09 to 0.14 for
  // 20000 beams (sd 0.002).
  std::vector<std::complex<float>> envelope(200 * 250);
  std::vector<float> amplitude(envelope.size()), beams(200, 0.0F);
  const random::Stream stream{1, "noise"};
  std::vector<Detection> detections;
  Settings settings{.pulse_length_s = 50e-6};
  int alarms = 0, alarms_at_13 = 0;
  for (std::uint64_t ping = 0; ping < 100; ++ping) {
    std::fill(envelope.begin(), envelope.end(), std::complex<float>{});
    random::add_gaussian(stream, ping, 0, 1.0F, envelope);
    for (std::size_t i = 0; i < envelope.size(); ++i) amplitude[i] = std::abs(envelope[i]);
    settings.gates.snr_db = 9;
    detect_bottom(settings, beams, {200, 250, 20e-3, 50e-6, amplitude}, detections);
    for (const Detection& d : detections) alarms += (d.flags & kLowSnr) == 0;
    settings.gates.snr_db = 13;
    detect_bottom(settings, beams, {200, 250, 20e-3, 50e-6, amplitude}, detections);
    for (const Detection& d : detections) alarms_at_13 += (d.flags & kLowSnr) == 0;
  }
  const double plain = 1 - std::pow(1 - std::exp(-std::pow(10, 0.9)), 250);  // 0.085
  CHECK(alarms / 20000.0 > plain);
  CHECK(alarms / 20000.0 < 1.6 * plain);
  // At 13 dB 250 exp(-20) = 5e-7 per beam, 1e-5 with the spread of the estimate: 0.2 are expected of 20000.
  CHECK(alarms_at_13 <= 2);
}

TEST_CASE("halves without a common phase leave the decision to the amplitude") {
  const auto plane = survey();
  PlaneEcho echo, other;
  echo.ping(plane, {3, "plane"}, 0);
  other.ping(plane, {4, "another plane"}, 0);
  std::vector<Detection> mixed, alone;
  const auto settings = settings_for(plane);
  detect_bottom(settings, plane.sin_beams, echo.amplitudes(plane), {echo.positive_upa, other.negative_upa}, mixed);
  detect_bottom(settings, plane.sin_beams, echo.amplitudes(plane), alone);
  for (const std::size_t beam : {0, 1, 2, 12, 13, 14}) {  // 50 to 70 degrees, where a ramp is long
    CHECK((mixed[beam].flags & kPoorFit) != 0);
    CHECK(mixed[beam].valid);
    CHECK(mixed[beam].two_way_s == alone[beam].two_way_s);
    CHECK(mixed[beam].angle_sd_rad == 0.0F);
  }
}

TEST_CASE("the energy of an echo is that of its scatterers") {
  auto plane = survey();
  PlaneEcho echo;
  std::vector<Detection> found;
  std::vector<double> energy(plane.sin_beams.size()), count(plane.sin_beams.size());
  for (std::uint64_t ping = 0; ping < 60; ++ping) {
    echo.ping(plane, {5, "plane"}, ping);
    detect_bottom(settings_for(plane), plane.sin_beams, echo.amplitudes(plane), echo.halves(), found);
    for (std::size_t beam = 0; beam < found.size(); ++beam) {
      if (!found[beam].valid) continue;
      energy[beam] += std::pow(10, 0.1 * found[beam].echo_energy_db) / plane.pulse_length_s;
      count[beam] += 1;
    }
  }
  // Beyond 40 degrees a beam receives 6 or more independent pulses: the mean of 60 has an sd of 0.23 dB or less. The
  // snippet cuts some 5 % of the pattern's skirts, and the second-order fall within the beam adds to them.
  for (const std::size_t beam : {0, 1, 2, 3, 11, 12, 13, 14}) {
    CHECK_THAT(10 * std::log10(energy[beam] / count[beam]), WithinAbs(-0.1, 0.7));
  }
}

TEST_CASE("a beam's area on the seabed") {
  // R psi_T times R psi_R / cos^2, equivalent widths 1.1288 times the half-power width of 1 degree: 40 m, 60 degrees.
  const double width = 1.1288 * kDeg * 40.0;
  CHECK(beam_area_m2(40.0, std::sin(60 * kDeg), 50.76, 50.76) == Approx(width * width / 0.25).epsilon(2e-3));
}

TEST_CASE("threads change no bit of a detection, and a second ping allocates nothing") {
  const auto plane = survey();
  PlaneEcho echo;
  echo.ping(plane, {3, "plane"}, 0);
  const auto detect_with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<Detection> found;
    detect_bottom(settings_for(plane), plane.sin_beams, echo.amplitudes(plane), echo.halves(), found);
    return found;
  };
  const auto one = detect_with(1), two = detect_with(2);
  for (std::size_t i = 0; i < one.size(); ++i) {
    REQUIRE(one[i].two_way_s == two[i].two_way_s);
    REQUIRE(one[i].quality == two[i].quality);
  }
  auto found = one;
  const long before = allocations();
  detect_bottom(settings_for(plane), plane.sin_beams, echo.amplitudes(plane), echo.halves(), found);
  CHECK(allocations() == before);
}

TEST_CASE("images that do not fit the beams are refused") {
  const std::vector<float> amplitude(20), beams(2);
  const std::vector<std::complex<float>> half(19);
  std::vector<Detection> found;
  CHECK_THROWS_WITH(detect_bottom({}, beams, {2, 11, 0.0, 50e-6, amplitude}, found),
                    "detect_bottom: 2 beams, but an image of 2 x 11 with 20 amplitudes");
  CHECK_THROWS_WITH(detect_bottom({}, beams, {2, 10, 0.0, 50e-6, amplitude}, {half, half}, found),
                    "detect_bottom: half apertures of 19 and 19 samples; none or 20 are allowed");
  CHECK_THROWS_WITH(detect_bottom({.max_detections = 9}, beams, {2, 10, 0.0, 50e-6, amplitude}, found),
                    "detect_bottom: max_detections is 9; 1 to 8 are allowed");
  CHECK_THROWS_WITH(detect_bottom({.pulse_length_s = 0.0}, beams, {2, 10, 0.0, 50e-6, amplitude}, found),
                    "detect_bottom: pulse_length_s is 0.000000; finite numbers above 0 are allowed");
  CHECK_THROWS_WITH(detect_bottom({}, beams, {2, 10, 0.0, 0.0, amplitude}, found),
                    "detect_bottom: period_s is 0.000000; finite numbers above 0 are allowed");
}

TEST_CASE("whatever is received, the detection is finite") {
  const random::Stream stream{8, "any"};
  const std::vector<float> beams{-1.0F, -0.99F, -0.3F, 0.0F, 0.02F, 0.7F, 1.0F};
  const int samples = 300;
  std::vector<std::complex<float>> positive(beams.size() * samples), negative(positive.size());
  std::vector<float> amplitude(positive.size());
  std::vector<Detection> found;
  int valid = 0;
  for (std::uint64_t n = 0; n < 300; ++n) {
    std::fill(positive.begin(), positive.end(), std::complex<float>{});
    std::fill(negative.begin(), negative.end(), std::complex<float>{});
    const auto level = static_cast<float>(std::pow(10.0, 20.0 * stream.uniform(n, 1) - 10.0));
    random::add_gaussian(stream, n, 0, level, positive);
    random::add_gaussian(stream, n, 1u << 20, level, negative);
    for (std::size_t i = 0; i < positive.size(); ++i) {
      if (stream.uniform(n, 2, i) < 0.01) positive[i] *= 1e3F;  // a spike in one half
      if (stream.uniform(n, 3) < 0.3 && i % 7 < 5) positive[i] = negative[i] = {};
      amplitude[i] = std::abs(positive[i] + negative[i]);
    }
    Settings settings;
    settings.pulse_length_s = std::pow(10.0, -5.0 + 3.0 * stream.uniform(n, 4));
    settings.receive_length_in_waves = std::pow(10.0, 3.0 * stream.uniform(n, 5) - 1.0);
    settings.phase_centres_in_waves = settings.receive_length_in_waves * stream.uniform(n, 6);
    settings.seabed_tilt_rad = 3.0 * (stream.uniform(n, 7) - 0.5);
    settings.absorption_dbpm = 0.4 * stream.uniform(n, 8);
    settings.gates.snr_db = 20.0 * stream.uniform(n, 9);
    settings.max_detections = 1 + static_cast<int>(n % kMostDetections);
    const double start_s = 0.1 * stream.uniform(n, 10);
    detect_bottom(settings, beams, {static_cast<int>(beams.size()), samples, start_s, 25e-6, amplitude},
                  {positive, negative}, found);
    for (const Detection& d : found) {
      valid += d.valid;
      REQUIRE(std::isfinite(d.two_way_s));
      REQUIRE(std::isfinite(d.range_sd_m));
      REQUIRE(std::isfinite(d.angle_sd_rad));
      REQUIRE(std::isfinite(d.phase_weight));
      REQUIRE(std::isfinite(d.snr_db));
      REQUIRE(std::isfinite(d.echo_energy_db));
      REQUIRE(std::isfinite(d.quality));
      REQUIRE(d.snippet_first >= 0);
      REQUIRE(d.snippet_count >= 0);
      REQUIRE(d.snippet_first + d.snippet_count <= samples);
    }
  }
  CHECK(valid > 100);
}

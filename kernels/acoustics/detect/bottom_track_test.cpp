#include "kernels/acoustics/detect/bottom_track.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "kernels/base/random/stream.h"

using namespace ensonify;
using namespace ensonify::detect;
using Catch::WithinAbs;

namespace {

constexpr double kStep = 0.05;

/// A line of 100 m: noise of 0 dB, the transmission, and from `altitude_m` on a seabed of 30 dB that falls by 40 log R.
std::vector<float> line_of(double altitude_m, std::uint64_t number, double seabed_db = 30.0) {
  std::vector<std::complex<float>> noise(2000), seabed(2000);
  random::add_gaussian({5, "noise"}, number, 0, std::sqrt(0.5F), noise);
  random::add_gaussian({5, "seabed"}, number, 0, std::sqrt(0.5F), seabed);
  std::vector<float> amplitude(2000);
  for (std::size_t k = 0; k < 2000; ++k) {
    const double range = kStep * static_cast<double>(k);
    const double db = range < altitude_m ? -100.0 : seabed_db - 40 * std::log10(range / altitude_m);
    amplitude[k] = std::abs(noise[k] + seabed[k] * static_cast<float>(std::pow(10, db / 20)));
    if (range < 0.8) amplitude[k] = 1e4F;
  }
  return amplitude;
}

}  // namespace

TEST_CASE("the first bottom is found within a few samples, and fish are not") {
  int missed = 0;
  for (std::uint64_t n = 0; n < 200; ++n) {
    const double altitude = 5.0 + 0.05 * static_cast<double>(n);
    auto amplitude = line_of(altitude, n);
    for (std::size_t k = 70; k < 74; ++k) amplitude[k] = 200.0F;  // 46 dB, 0.2 m long, at 3.5 m
    const BottomPick pick = first_bottom({}, {amplitude, 0.0, kStep});
    if (!pick.found) {
      ++missed;
      continue;
    }
    // A sample 18 dB below the seabed's mean, where the threshold is, is rare (1.6 %): the pick is late by one such
    // run.
    CHECK(pick.altitude_m >= altitude - 1e-9);
    CHECK(pick.altitude_m <= altitude + 3 * kStep);
  }
  CHECK(missed == 0);
}

TEST_CASE("an echo of one pulse is not the bottom, however many samples it fills") {
  for (const std::size_t pulse : {1, 2, 3, 7, 20, 40}) {
    FirstBottomSettings settings;
    settings.persistence_m = 0.1;
    settings.echo_m = kStep * static_cast<double>(pulse);
    auto amplitude = line_of(10.0, pulse);
    for (std::size_t k = 70; k < 70 + pulse; ++k) amplitude[k] = 200.0F;  // 46 dB at 3.5 m
    INFO(pulse << " samples per pulse");
    const BottomPick pick = first_bottom(settings, {amplitude, 0.0, kStep});
    CHECK(pick.found);
    CHECK(pick.altitude_m >= 10.0 - 1e-9);
    CHECK(pick.altitude_m <= 10.0 + 3 * kStep);
    // A fifth of a pulse more, and two samples, is the bottom.
    for (std::size_t k = 70; k < 72 + pulse + pulse / 5; ++k) amplitude[k] = 200.0F;
    CHECK(first_bottom(settings, {amplitude, 0.0, kStep}).altitude_m == Approx(3.5));
  }
}

TEST_CASE("nothing is the bottom within the blanking and the water that it is judged by") {
  auto amplitude = line_of(10.0, 1);
  for (std::size_t k = 50; k < 120; ++k) amplitude[k] = 200.0F;  // from 2.5 to 6 m
  FirstBottomSettings settings;
  CHECK(first_bottom(settings, {amplitude, 0.0, kStep}).altitude_m == Approx(2.5));
  settings.blanking_m = 6.0;
  CHECK_THAT(first_bottom(settings, {amplitude, 0.0, kStep}).altitude_m, WithinAbs(10.0, 3 * kStep));
}

TEST_CASE("a line of noise has no bottom") {
  int picks = 0;
  for (std::uint64_t n = 0; n < 500; ++n) picks += first_bottom({}, {line_of(1e4, n), 0.0, kStep}).found;
  CHECK(picks == 0);
}

TEST_CASE("the track follows a slope, bridges gaps, and starts again after a step") {
  const FirstBottomSettings settings;
  BottomTrack track;
  std::uint64_t n = 0;
  const auto feed = [&](double altitude_m, double seabed_db = 30.0) {
    track = follow(settings, track, {line_of(altitude_m, n++, seabed_db), 0.0, kStep});
  };
  for (int i = 0; i < 20; ++i) feed(10.0 + 0.2 * i);
  CHECK(track.tracked);
  CHECK_THAT(track.altitude_m, WithinAbs(13.8, 0.15));
  for (int i = 0; i < 5; ++i) feed(13.8, -100.0);  // nothing received
  CHECK(track.tracked);
  CHECK(track.missed == 5);
  CHECK_THAT(track.altitude_m, WithinAbs(13.8, 0.15));
  feed(14.0);
  CHECK(track.missed == 0);
  for (int i = 0; i < 6; ++i) feed(40.0);  // a step that nothing tows over: not accepted at once
  CHECK_THAT(track.altitude_m, WithinAbs(14.0, 0.15));
  feed(40.0);
  CHECK_THAT(track.altitude_m, WithinAbs(40.0, 0.15));
}

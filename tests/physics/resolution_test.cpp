#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/echo/aperture.h"
#include "tests/physics/dip.h"

// Two equal points, seen by a line of 0.5 degrees that transmits and receives, as sums of mean squares: the mean over
// the points' phases.

using namespace ensonify;
using namespace ensonify::physics;
using Catch::WithinAbs;
using frames::Vec3;

namespace {

constexpr double kSpeed_mps = 1500.0, kRange_m = 50.0;
constexpr double kWidth_rad = 0.5 * std::numbers::pi / 180.0;

/// What a head at `forward_m` along its track receives of points beside the track, near 50 m to starboard.
std::vector<double> receive(const std::vector<Vec3>& points_enu_m, double forward_m, const echo::Pulse& pulse,
                            double period_s) {
  const double waves = array::length_in_waves_for(kWidth_rad);
  const frames::HeadPose head{{0.0, forward_m, 0.0}, frames::enu_from_ned()};
  echo::Scatterers points;
  for (const Vec3& place : points_enu_m) {
    const Vec3 offset = place - head.position_enu_m;
    echo::Scatterer point;
    point.position_enu_m = place;
    point.slowness_spm = static_cast<float>(1.0 / kSpeed_mps);
    point.scattered_upa2m2 = static_cast<float>(array::line_power(waves, offset.y() / offset.norm()));
    points.push_back(point);
  }
  echo::Receivers receivers;
  receivers.set({0.0, 1.0, std::span(&head, 1)});
  echo::Arrivals arrivals;
  echo::add_direct_echoes({400e3, 0.0, echo::Sum::kMeanSquare}, head.position_enu_m, points, receivers, arrivals);
  std::vector<float> power;
  for (const auto& a : arrivals) {
    power.push_back(static_cast<float>(array::line_power(waves, double(a.direction_head.x()))));
  }
  const double first_s = 2.0 * (kRange_m - 0.5) / kSpeed_mps;
  echo::Image image;
  echo::TimeIndex index;
  echo::form_apertures(std::array{echo::EchoSet{arrivals, power}}, 1, echo::SampledPulse(pulse, period_s).squared(),
                       {first_s, period_s, static_cast<int>(2.0 / kSpeed_mps / period_s)}, index, image);
  std::vector<double> received;
  for (const auto& p2 : image.row(0)) received.push_back(static_cast<double>(p2.real()));
  return received;
}

/// Of two points `apart_m` of slant range apart, at 16 places between samples.
Dips across_track(const echo::Pulse& pulse, double period_s, double apart_m) {
  Dips dips;
  for (int i = 0; i < 16; ++i) {
    const double near_m = kRange_m + i * 0.5 * kSpeed_mps * period_s / 16;
    dips.add(dip_db(receive({{near_m, 0.0, 0.0}, {near_m + apart_m, 0.0, 0.0}}, 0.0, pulse, period_s)));
  }
  return dips;
}

double along_track(double apart_m) {
  std::vector<double> passing;
  const echo::Pulse pulse = echo::rectangular_pulse(100e-6);
  for (double forward_m = -1.0; forward_m <= 1.0; forward_m += 0.02) {
    const auto received =
        receive({{kRange_m, -0.5 * apart_m, 0.0}, {kRange_m, 0.5 * apart_m, 0.0}}, forward_m, pulse, 50e-6);
    passing.push_back(*std::max_element(received.begin(), received.end()));
  }
  return dip_db(passing);
}

}  // namespace

TEST_CASE("across track, tones part points 1.2 x c tau / 2 apart and not 0.7 x") {
  // 6 samples a pulse, so that one falls into the silence of 0.2 tau between the two wherever they lie.
  constexpr double kPulse_s = 100e-6, kCell_m = 0.5 * kSpeed_mps * kPulse_s;
  const echo::Pulse tone = echo::rectangular_pulse(kPulse_s);
  CHECK(across_track(tone, kPulse_s / 6.0, 1.2 * kCell_m).shallowest > 3.0);
  CHECK(across_track(tone, kPulse_s / 6.0, 0.7 * kCell_m).deepest < 1e-3);
}

TEST_CASE("at two samples a pulse points are resolved from 1.5 x c tau / 2 on") {
  constexpr double kPulse_s = 100e-6, kCell_m = 0.5 * kSpeed_mps * kPulse_s, kPeriod_s = 0.5 * kPulse_s;
  const echo::Pulse tone = echo::rectangular_pulse(kPulse_s);
  CHECK(across_track(tone, kPeriod_s, 1.5 * kCell_m + 1e-3).shallowest > 3.0);
  CHECK(across_track(tone, kPeriod_s, 1.2 * kCell_m).deepest > 3.0);
  CHECK(across_track(tone, kPeriod_s, 1.2 * kCell_m).shallowest < 3.0);
  CHECK(across_track(tone, kPeriod_s, 0.7 * kCell_m).deepest < 1e-3);
}

TEST_CASE("across track, chirps part points 1.2 x c / 2B apart and not 0.7 x") {
  // sinc^2: 10 log10[(1 + sinc^2(1.2)) / 2 sinc^2(0.6)] = 3.04 dB; at 0.7 the middle stands higher than the points.
  // A sweep of B T = 800: its envelope is sinc(B t (1 - t / T)), so that 0.6 is 0.5996 and 0.01 dB is lost.
  constexpr double kBandwidth_hz = 40e3, kCell_m = 0.5 * kSpeed_mps / kBandwidth_hz;
  const echo::Pulse chirp = echo::compressed_chirp(20e-3, kBandwidth_hz);
  const double theory_db = db((1.0 + std::pow(array::sinc(1.2), 2)) / (2.0 * std::pow(array::sinc(0.6), 2)));
  CHECK_THAT(theory_db, WithinAbs(3.04, 0.005));
  const Dips apart = across_track(chirp, 0.05 / kBandwidth_hz, 1.2 * kCell_m);
  CHECK_THAT(apart.shallowest, WithinAbs(theory_db, 0.05));
  CHECK(apart.shallowest > 3.0);
  CHECK(across_track(chirp, 0.05 / kBandwidth_hz, 0.7 * kCell_m).deepest < 0.1);
}

TEST_CASE("along track, a sidescan parts points 1.2 one-way beam widths apart and not 0.7") {
  // sinc^4: at 1.2 x 0.886 lambda / L the middle is 2 sinc^4(0.532) of a point, 5.9 dB down; at 0.7 it is 0.05 dB.
  const double width_m = kRange_m * kWidth_rad;
  CHECK_THAT(along_track(1.2 * width_m), WithinAbs(5.9, 0.3));
  CHECK(along_track(0.7 * width_m) < 0.2);
}

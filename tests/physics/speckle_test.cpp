#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "kernels/acoustics/array/line.h"
#include "tests/physics/correlation.h"
#include "tests/physics/mills_cross.h"
#include "tests/physics/sidescan_ping.h"

// Speckle of a sidescan over homogeneous sand, by the head itself: amplitudes over the square root of the mean square
// that the same head gives with speckle off, so that the fall of the level over range does not enter.

using namespace ensonify;
using namespace ensonify::physics;

namespace {

constexpr double kAltitude_m = 10.0;
constexpr std::size_t kPulse = 2;  // samples: echoes of samples so far apart share no seabed

trace::Scene& level_sand() {
  static trace::Scene scene = scene_of(256.0, 1.0, [](double, double) { return -12.0 - kAltitude_m; });
  return scene;
}

SidescanConfig head(std::uint64_t seed) {
  SidescanConfig config = sidescan_of(400e3);
  config.world.seed = seed;
  return config;
}

/// Amplitudes of both sides from 15 to 100 m, of mean square 1, a pulse apart.
std::vector<double> speckle(SidescanConfig config, const frames::Vec3& position_enu_m) {
  const auto ping = sidescan_ping(config, level_sand(), position_enu_m);
  config.effects.speckle = false;
  const auto mean = sidescan_ping(config, level_sand(), position_enu_m);
  const Samples from_nadir = samples_about(ping, 57.5, 42.5);
  std::vector<double> amplitudes;
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t k = from_nadir.first; k < from_nadir.end; k += kPulse) {
      amplitudes.push_back(static_cast<double>(ping.amplitude_upa(side, k) / mean.amplitude_upa(side, k)));
    }
  }
  return amplitudes;
}

/// Of the powers of the same echoes at two places, over some seabeds.
double correlation_after(const frames::Vec3& moved_m, int seabeds) {
  std::vector<double> here, there;
  for (int seed = 1; seed <= seabeds; ++seed) {
    const auto a = speckle(head(seed), {0.0, 0.0, -12.0}), b = speckle(head(seed), frames::Vec3(0, 0, -12) + moved_m);
    here.insert(here.end(), a.begin(), a.end());
    there.insert(there.end(), b.begin(), b.end());
  }
  return power_correlation(here, there);
}

double line_m() { return array::length_in_waves_for(head(1).channels[0].horizontal_beamwidth_rad) * 1500.0 / 400e3; }

/// Of the powers of two pings d apart along a uniform line that transmits and receives, mean over the ranges. Of the
/// scatterers at the sine u seen from between the two places the echoes differ by the phase 2 k d u, and the patterns
/// are those at u +- d / 2R (van Cittert and Zernike). Far away that is the cubic spline 1 - 6 x^2 + 6 x^3, x = d / L
/// below 1/2, and 2 (1 - x)^3 above.
double along_track(double d_over_l) {
  const double waves = line_m() * 400e3 / 1500.0, end = 3.0 / waves;
  constexpr int kSteps = 400, kRanges = 40;
  double mean = 0.0;
  for (int r = 0; r < kRanges; ++r) {
    const double aside = 0.5 * d_over_l * line_m() / (15.0 + 85.0 * (r + 0.5) / kRanges);
    double cross = 0.0, own = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double u = end * (2.0 * (i + 0.5) / kSteps - 1.0);
      cross += array::line_power(waves, u + aside) * array::line_power(waves, u - aside) *
               std::cos(4.0 * std::numbers::pi * d_over_l * waves * u);
      own += std::pow(array::line_power(waves, u), 2);
    }
    mean += std::pow(cross / own, 2) / kRanges;
  }
  return mean;
}

/// The same after d across the track: samples of the same time share 1 - 2 d cos(grazing) / (c tau) of their pulses.
double across_track(double d_m) { return std::pow(std::max(1.0 - 0.97 * d_m / 0.075, 0.0), 2); }

}  // namespace

TEST_CASE("speckle is Rayleigh: 40 seeds, and its coefficient of variation") {
  // Kolmogorov and Smirnov at 5 %: of 40 tests 2 fail in the mean, and 6 or fewer do in 98.6 % of all choices of seeds.
  // The coefficient of variation of N = 90,000 Rayleigh amplitudes has a relative standard deviation of about
  // 1 / (2 sqrt(N)) = 0.17 %.
  int rejected = 0;
  double n = 0.0, sum = 0.0, squares = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    auto amplitudes = speckle(head(seed), {0.0, 0.0, -12.0});
    std::sort(amplitudes.begin(), amplitudes.end());
    const double count = static_cast<double>(amplitudes.size());
    double distance = 0.0;
    for (std::size_t i = 0; i < amplitudes.size(); ++i) {
      const double expected = 1.0 - std::exp(-amplitudes[i] * amplitudes[i]);
      distance = std::max({distance, std::abs(static_cast<double>(i) / count - expected),
                           std::abs(static_cast<double>(i + 1) / count - expected)});
      sum += amplitudes[i], squares += amplitudes[i] * amplitudes[i];
    }
    n += count;
    rejected += distance > 1.358 / std::sqrt(count);
  }
  REQUIRE(n >= 70'000);
  INFO(rejected << " of 40 rejected, " << n << " samples");
  CHECK(rejected <= 6);
  const double mean = sum / n;
  CHECK(std::sqrt(squares / n - mean * mean) / mean == Approx(0.5227).epsilon(0.01));
  CHECK(squares / n == Approx(1.0).epsilon(0.02));  // N exponentials: 0.33 %
}

TEST_CASE("a head at rest receives the same seabed again") {
  const bool again = speckle(head(1), {0.0, 0.0, -12.0}) == speckle(head(1), {0.0, 0.0, -12.0});
  CHECK(again);
}

TEST_CASE("sidescan: pings decorrelate along the track as the two-way pattern says") {
  // Echoes from 15 to 100 m, three seabeds: 6,800 independent samples, so a correlation has a standard deviation of 1.2
  // to 2 %. Places that rays aim at wander a little on the seabed, and cells at the rim of what is received come and
  // go.
  for (const double d_over_l : {0.02, 0.1, 0.25, 0.5, 1.05}) {
    const double reached = correlation_after({0.0, d_over_l * line_m(), 0.0}, 3);
    INFO(reached << " after " << d_over_l << " L, theory " << along_track(d_over_l));
    CHECK(reached == Approx(along_track(d_over_l)).margin(0.05));
  }
}

TEST_CASE("sidescan: pings decorrelate across the track as pulses overlap") {
  // Across the track by d, starboard comes nearer by d cos(grazing), 0.75 to 0.99 d from 15 m on: 0.97 d in the mean.
  for (const double d_m : {0.01, 0.03}) {
    const double reached = correlation_after({d_m, 0.0, 0.0}, 3);
    INFO(reached << " after " << d_m << " m, theory " << across_track(d_m));
    CHECK(reached == Approx(across_track(d_m)).margin(0.08));
  }
}

TEST_CASE("correlation for the picture", "[.speckle-csv]") {
  std::puts("kind,moved,correlation,theory");
  for (int i = 0; i <= 11; ++i) {
    const double x = 0.1 * i;
    std::printf("0,%.3f,%.5f,%.5f\n", x, correlation_after({0.0, x * line_m(), 0.0}, 3), along_track(x));
  }
  for (int i = 0; i <= 8; ++i) {
    const double x = 0.01 * i;
    std::printf("1,%.3f,%.5f,%.5f\n", x, correlation_after({x, 0.0, 0.0}, 3), across_track(x));
  }
}

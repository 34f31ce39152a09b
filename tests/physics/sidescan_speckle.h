#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "components/sonar/testing/config.h"
#include "kernels/acoustics/array/line.h"
#include "tests/physics/correlation.h"
#include "tests/physics/mills_cross.h"
#include "tests/physics/sidescan_ping.h"

/// Speckle of a sidescan over homogeneous sand, by the head itself: amplitudes over the square root of the mean square
/// that the same head gives with speckle off, so that the fall of the level over range does not enter.
namespace ensonify::physics::sidescan_speckle {

inline constexpr double kAltitude_m = 10.0;
inline constexpr std::size_t kPulse = 2;  // samples: echoes of samples so far apart share no seabed

inline trace::Scene& level_sand() {
  static trace::Scene scene = scene_of(256.0, 1.0, [](double, double) { return -12.0 - kAltitude_m; });
  return scene;
}

inline SidescanConfig head(std::uint64_t seed) {
  SidescanConfig config = sidescan_of(400e3);
  world_of(config).seed = seed;
  return config;
}

/// Amplitudes of both sides from 15 to 100 m, of mean square 1, a pulse apart.
inline std::vector<double> speckle(SidescanConfig config, const frames::Vec3& position_enu_m) {
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
inline double correlation_after(const frames::Vec3& moved_m, int seabeds) {
  std::vector<double> here, there;
  for (int seed = 1; seed <= seabeds; ++seed) {
    const auto a = speckle(head(seed), {0.0, 0.0, -12.0}), b = speckle(head(seed), frames::Vec3(0, 0, -12) + moved_m);
    here.insert(here.end(), a.begin(), a.end());
    there.insert(there.end(), b.begin(), b.end());
  }
  return power_correlation(here, there);
}

inline double line_m() {
  return array::length_in_waves_for(head(1).channels[0].horizontal_beamwidth_rad) * 1500.0 / 400e3;
}

/// Of the powers of two pings d apart along a uniform line that transmits and receives, mean over the ranges. Of the
/// scatterers at the sine u seen from between the two places the echoes differ by the phase 2 k d u, and the patterns
/// are those at u +- d / 2R (van Cittert and Zernike). Far away that is the cubic spline 1 - 6 x^2 + 6 x^3, x = d / L
/// below 1/2, and 2 (1 - x)^3 above.
inline double along_track(double d_over_l) {
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
inline double across_track(double d_m) { return std::pow(std::max(1.0 - 0.97 * d_m / 0.075, 0.0), 2); }

}  // namespace ensonify::physics::sidescan_speckle

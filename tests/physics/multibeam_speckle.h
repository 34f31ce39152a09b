#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "components/multibeam/arrays.h"
#include "components/multibeam/node.h"
#include "components/sonar/testing/seabed.h"
#include "kernels/acoustics/array/line.h"
#include "tests/physics/correlation.h"
#include "tests/physics/heads.h"

/// Speckle of a multibeam over homogeneous sand, by the head through its ports, with patches of half its range
/// resolution.
namespace ensonify::physics::multibeam_speckle {

inline constexpr double kDepth_m = 20.0;
inline constexpr std::size_t kPulse = 2;  // samples

inline msg::Ping receive(std::uint64_t seed, const frames::Vec3& moved_m, bool speckle) {
  World world = world_with("head");
  world.seed = seed;
  world.water.profile.sound_speed_mps = 1500.0;
  const std::string yaml =
      "beams: 64\nquality: 1\nauto_range: false\nrange_m: 50\nping_rate_hz: 5\n"
      "effects: {noise: false, volume: false, multipath: false, tvg: false, speckle: " +
      std::string(speckle ? "true" : "false") + "}\n";
  NodeUnderTest<MultibeamNode> head(config_of<MultibeamNode>(yaml, world, "head"));
  give_course(head, {moved_m}, 150_ms);
  head.give("tile", tile_of(256.0, 1.0, [](double, double) { return -kDepth_m; }));
  return head.step_until<msg::Ping>("ping", 150_ms).at(0);
}

/// Amplitudes within the beams from 43 to 60 degrees, two degrees apart, a pulse apart.
inline std::vector<double> amplitudes_of(const msg::Ping& ping) {
  std::vector<double> amplitudes;
  for (std::size_t beam = 0; beam < ping.amplitude_upa.rows(); ++beam) {
    const double angle_rad = std::abs(double(ping.beam_angle_rad[beam]));
    if (angle_rad < 0.75 || angle_rad > 1.05) continue;
    const double half_rad = 0.0087 / std::cos(angle_rad);  // to the -3 dB edges
    const auto sample_at = [&](double angle) {
      return static_cast<std::size_t>((kDepth_m / std::cos(angle) / 750.0 + 0.5 * ping.applied.pulse_length_s) /
                                      double(ping.sample_period_s));
    };
    for (std::size_t k = sample_at(angle_rad - half_rad); k <= sample_at(angle_rad + half_rad); k += kPulse) {
      amplitudes.push_back(double(ping.amplitude_upa(beam, k)));
    }
  }
  return amplitudes;
}

/// Mean squares of the same, over some seeds: what one seed's rays and scatterers leave is uneven, at both places
/// alike.
inline std::vector<double> mean_squares() {
  constexpr int kSeeds = 8;
  std::vector<double> mean;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto one = amplitudes_of(receive(seed, frames::Vec3::Zero(), false));
    mean.resize(one.size());
    for (std::size_t i = 0; i < one.size(); ++i) mean[i] += one[i] * one[i] / kSeeds;
  }
  return mean;
}

/// Of mean square 1.
inline std::vector<double> speckle(std::uint64_t seed, const frames::Vec3& moved_m) {
  static const std::vector<double> mean = mean_squares();
  auto amplitudes = amplitudes_of(receive(seed, moved_m, true));
  for (std::size_t i = 0; i < amplitudes.size(); ++i) amplitudes[i] /= std::sqrt(mean[i]);
  return amplitudes;
}

inline double correlation_after(const frames::Vec3& moved_m, std::uint64_t seabeds) {
  std::vector<double> here, there;
  for (std::uint64_t seed = 1; seed <= seabeds; ++seed) {
    const auto a = speckle(seed, frames::Vec3::Zero()), b = speckle(seed, moved_m);
    here.insert(here.end(), a.begin(), a.end());
    there.insert(there.end(), b.begin(), b.end());
  }
  return power_correlation(here, there);
}

inline constexpr double kWave_m = 1500.0 / 300e3;

/// Length of the transmit line, m.
inline double line_m() { return ArrayDesign(MultibeamConfig{}).transmit.length_m(); }

/// Of the powers of two pings d apart. A line transmits and what receives is short along the track: coherence is the
/// transform of the transmitted power over the sine u, at 2 d / lambda (van Cittert and Zernike), here of the side
/// lobes that rays reach. Over a uniform line's it would be the triangle 1 - 2 d / L.
inline double along_track(double d_over_l) {
  constexpr int kSteps = 4000;
  static const array::LineArray line = ArrayDesign(MultibeamConfig{}).transmit;
  static const double reach = 8.0 / array::length_in_waves_for(MultibeamConfig{}.transmit_beamwidth_rad);
  double cross = 0.0, own = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double u = reach * (2.0 * (i + 0.5) / kSteps - 1.0), power = array::power(line, kWave_m, u);
    cross += power * std::cos(4.0 * std::numbers::pi * d_over_l * line.length_m() / kWave_m * u), own += power;
  }
  return std::pow(cross / own, 2);
}

}  // namespace ensonify::physics::multibeam_speckle

#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/echo/aperture.h"
#include "kernels/acoustics/echo/testing/flat_seabed.h"
#include "kernels/acoustics/echo/testing/found.h"

/// Test support: speckle of a strip of flat seabed.
namespace ensonify::echo {

inline constexpr double kDepth = 20.0, kFrequency = 300e3, kWave = kSpeed / kFrequency;
inline constexpr double kLines = 50.76;  // length of the transmit line in waves: 1 deg

/// Rays of a strip about 45 deg to starboard, the same for every ping, and the flat seabed that they hit.
struct Strip {
  trace::Rays rays;
  std::vector<float> source, backscatter;

  Strip() {
    const random::Stream jitter{4, "rays"};
    constexpr int kAlong = 200, kAcross = 180;
    const double reach = 3.0 / kLines, from = 44 * kDeg, to = 46 * kDeg;
    for (int j = 0; j < kAcross; ++j) {
      for (int i = 0; i < kAlong; ++i) {
        const double u = reach * (2 * (i + jitter.uniform(i, j, 0)) / kAlong - 1);
        const double phi = from + (to - from) * (j + jitter.uniform(i, j, 1)) / kAcross;
        const double beside = std::sqrt(1 - u * u);
        rays.push_back({frames::Vec3(u, beside * std::sin(phi), beside * std::cos(phi)).cast<float>(),
                        float(2 * reach / kAlong * (to - from) / kAcross)});
        source.push_back(float(1e20 * array::line_power(kLines, u)));
        backscatter.push_back(0.01F);
      }
    }
  }

  trace::Hits hits(const frames::HeadPose& pose) const {
    trace::Hits found;
    for (const trace::Ray& ray : rays) {
      const frames::Vec3 direction = pose.enu_from_head * ray.direction_head.cast<double>();
      trace::Hit hit;
      const double range = (kDepth + pose.position_enu_m.z()) / -direction.z();
      hit.position_enu_m = pose.position_enu_m + range * direction;
      hit.arrival_enu = direction.cast<float>();
      hit.range_m = hit.path_length_m = float(range);
      hit.travel_time_s = float(range / kSpeed);
      hit.tube_m2 = float(range * range);
      hit.sin_grazing = float(-direction.z());
      found.push_back(hit);
    }
    return found;
  }

  /// What an omnidirectional receiver beside the transmitter receives.
  std::vector<std::complex<float>> echo(const frames::Vec3& position_enu_m, std::uint64_t seed,
                                        const CellSize& size = 0.03) const {
    const frames::HeadPose pose{position_enu_m, frames::enu_from_ned()};
    const auto surface_hits = hits(pose);
    SpeckleCells cells(size, {seed, "seabed"});
    Receivers receivers;
    receivers.set({0, 1, std::span(&pose, 1)});
    Arrivals arrivals;
    add_direct_echoes({kFrequency, 0.07}, position_enu_m,
                      scatterers_of(cells, {pose, rays, surface_hits, source, backscatter}), receivers, arrivals);
    TimeIndex index;
    Image image;
    const SampledPulse pulse(rectangular_pulse(100e-6), 50e-6);
    form_apertures(std::array{EchoSet{arrivals}}, 1, pulse, {37.3e-3, 50e-6, 18}, index, image);  // 44.2 to 45.5 deg
    return image.envelope_upa;
  }
};

inline const Strip& strip() {
  static const Strip value;
  return value;
}

/// Magnitude of the correlation of echoes at two places, over all samples and some seabeds.
inline double coherence(const frames::Vec3& a, const frames::Vec3& b, int seabeds, const CellSize& size = 0.03) {
  std::complex<double> cross;
  double first = 0, second = 0;
  for (int seed = 0; seed < seabeds; ++seed) {
    const auto p = strip().echo(a, seed, size), q = strip().echo(b, seed, size);
    for (std::size_t k = 0; k < p.size(); ++k) {
      cross += std::complex<double>(p[k]) * std::conj(std::complex<double>(q[k]));
      first += std::norm(p[k]);
      second += std::norm(q[k]);
    }
  }
  return std::abs(cross) / std::sqrt(first * second);
}

}  // namespace ensonify::echo

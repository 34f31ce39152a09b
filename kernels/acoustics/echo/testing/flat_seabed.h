#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/echo/aperture.h"
#include "kernels/acoustics/echo/line_receiver.h"
#include "kernels/acoustics/echo/testing/found.h"
#include "kernels/seabed/backscatter.h"
#include "tests/support/fan.h"

/// Test support: mean levels of a flat Lambert seabed, as sums of mean squares: no speckle, no draws.
namespace ensonify::echo {

inline constexpr double kDeg = std::numbers::pi / 180.0;
inline constexpr double kSpeed = 1500.0;

/// A flat Lambert seabed below a level head, as mean-square arrivals.
struct Flat {
  double source_level_db, transmit_waves, absorption_dbpm, depth_m, half_swath_rad;
  int along, across;

  Arrivals arrivals() const {
    const frames::HeadPose pose{};
    trace::Rays rays;
    trace::Fan({.transmit_length_in_waves = transmit_waves,
                .half_swath_rad = half_swath_rad,
                .along = along,
                .across = across})
        .fill({9, "rays"}, 0, rays);
    trace::Hits hits;
    std::vector<float> source, backscatter;
    for (const auto& ray : rays) {
      const frames::Vec3 direction = pose.enu_from_head * ray.direction_head.cast<double>();
      trace::Hit hit;
      const double range = depth_m / -direction.z();
      hit.position_enu_m = range * direction;
      hit.range_m = hit.path_length_m = float(range);
      hit.travel_time_s = float(range / kSpeed);
      hit.tube_m2 = float(range * range);
      hit.sin_grazing = float(-direction.z());
      hits.push_back(hit);
      source.push_back(
          float(std::pow(10, 0.1 * source_level_db) * array::line_power(transmit_waves, ray.direction_head.x())));
      backscatter.push_back(float(seabed::lambert_backscatter(-25, hit.sin_grazing)));
    }
    SpeckleCells cells(0.01, {1, "seabed"});
    Receivers receivers;
    receivers.set({0, 1, std::span(&pose, 1)});
    Arrivals arrivals;
    add_direct_echoes({300e3, absorption_dbpm, Sum::kMeanSquare}, {0, 0, 0},
                      scatterers_of(cells, {pose, rays, hits, source, backscatter}), receivers, arrivals);
    return arrivals;
  }
};

/// SL 210 dB, 100 us, one line of 0.5 deg both ways, 0.1 dB/m, 10 m above a -25 dB seabed, starboard.
inline Image sidescan_mean_square(double waves) {
  const auto arrivals = Flat{210, waves, 0.1, 10, 1.5, 24, 8192}.arrivals();
  std::vector<float> gain;
  for (const Arrival& arrival : arrivals) {  // power
    const bool starboard = arrival.direction_head.y() > 0;
    gain.push_back(starboard ? float(array::line_power(waves, arrival.direction_head.x())) : 0.0F);
  }
  const SampledPulse pulse = SampledPulse(rectangular_pulse(100e-6), 50e-6).squared();
  TimeIndex index;
  Image image;
  form_apertures(std::array{EchoSet{arrivals, gain}}, 1, pulse, {0, 50e-6, 2800}, index, image);
  return image;
}

/// About 70 rays share a pulse; the mean over +-0.7 m of slant range removes what is left of their scatter.
inline double sidescan_level_db(const Image& image, double range_m) {
  // The echo at time t is that of slant ranges c (t - tau) / 2 .. c t / 2: their middle is the range.
  const int k = int(std::lround((2 * range_m / kSpeed + 50e-6) / 50e-6));
  double sum_db = 0.0;
  for (int i = -19; i <= 19; ++i) sum_db += 10 * std::log10(image.row(0)[k + i].real()) / 39;
  return sum_db;
}

inline constexpr double kOneDegree = 1.0 * kDeg;

inline Arrivals below_a_multibeam(int along, int across) {
  return Flat{220, array::length_in_waves_for(kOneDegree), 0.07, 20, 70 * kDeg, along, across}.arrivals();
}

inline double peak_db(const Arrivals& arrivals, double beam_rad, double period_s) {
  const array::LineArray line = array::line_array_of_width(kOneDegree, 5e-3);
  const LineReceiver receiver(element_line(line, 5e-3), true);
  const std::vector<WantedImage> wanted{WantedImage(beam_weights(line.weights), Sum::kMeanSquare)};
  const SampledPulse pulse(rectangular_pulse(100e-6), period_s), squared = pulse.squared();
  std::vector<Image> images(1);
  const std::vector<float> beam{float(std::sin(beam_rad))};
  LineReceiver::Memory memory;
  receiver.form({std::array{EchoSet{arrivals}}, pulse, {0, period_s, int(0.08 / period_s)}, {}, &squared}, beam, wanted,
                images, memory);
  double peak = 0.0;
  for (const auto p : images[0].row(0)) peak = std::max(peak, double(std::norm(p)));
  return 10 * std::log10(peak);
}

}  // namespace ensonify::echo

#include "tests/support/fan.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ensonify::trace {
namespace {

constexpr std::size_t kRowsTogether = 4;

std::vector<double> sine_edges(double length_in_waves, double along_reach, int along) {
  const double core = 0.6 / length_in_waves;
  const double reach = std::min(along_reach / length_in_waves, 1.0);
  const double end = std::atan(reach / core);
  std::vector<double> edges;
  for (int i = 0; i <= along; ++i) edges.push_back(core * std::tan(end * (2.0 * i / along - 1.0)));
  return edges;
}

frames::Vec3 direction_of(double u, double phi_rad) {
  const double beside = std::sqrt(1.0 - u * u);
  return {u, beside * std::sin(phi_rad), beside * std::cos(phi_rad)};
}

/// Share of the rows between the vertical and phi >= 0: range is H / cos(phi) on a flat seabed.
double rows_within(double phi_rad, const FanShape& shape) {
  const double in_angle = phi_rad / shape.half_swath_rad;
  const double in_range = (1.0 / std::cos(phi_rad) - 1.0) / (1.0 / std::cos(shape.half_swath_rad) - 1.0);
  return (1.0 - shape.grazing_share) * in_angle + shape.grazing_share * in_range;
}

std::vector<double> across_edges_rad(const FanShape& shape) {
  std::vector<double> edges;
  for (int i = 0; i <= shape.across; ++i) {
    const double share = 2.0 * i / shape.across - 1.0;
    double low = 0.0, high = shape.half_swath_rad;
    for (int step = 0; step < 60; ++step) {  // bisection: 60 halvings exhaust a double
      const double middle = 0.5 * (low + high);
      (rows_within(middle, shape) < std::abs(share) ? low : high) = middle;
    }
    edges.push_back(std::copysign(0.5 * (low + high), share));
  }
  return edges;
}

}  // namespace

Fan::Fan(const FanShape& shape) {
  if (shape.along < 1 || shape.across < 1 || !(shape.transmit_length_in_waves > 0.0) || !(shape.along_reach > 0.0)) {
    throw std::invalid_argument("a fan needs rays, an array length and a reach, all positive");
  }
  if (!(shape.half_swath_rad > 0.0 && shape.half_swath_rad < 1.57)) {
    throw std::invalid_argument("the half swath of a fan must lie between 0 and 90 degrees");
  }
  sine_edges_ = sine_edges(shape.transmit_length_in_waves, shape.along_reach, shape.along);
  across_edges_rad_ = across_edges_rad(shape);
}

void Fan::fill(const random::Stream& jitter, std::uint64_t ping, Rays& rays) const {
  const std::size_t along = sine_edges_.size() - 1, across = across_edges_rad_.size() - 1;
  rays.resize(along * across);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const std::size_t first_row = i / (along * kRowsTogether) * kRowsTogether;
    const std::size_t rows = std::min(kRowsTogether, across - first_row);
    const std::size_t a = (i - first_row * along) / rows, b = first_row + (i - first_row * along) % rows;
    const auto bits = jitter.bits(ping, i);
    const double du = sine_edges_[a + 1] - sine_edges_[a];
    const double dphi = across_edges_rad_[b + 1] - across_edges_rad_[b];
    const double u = sine_edges_[a] + du * (0x1p-32 * bits[0]);
    const double phi = across_edges_rad_[b] + dphi * (0x1p-32 * bits[1]);
    rays.set(i, {direction_of(u, phi).cast<float>(), static_cast<float>(du * dphi)});
  }
}

}  // namespace ensonify::trace

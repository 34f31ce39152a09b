#include "kernels/trace/fan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ensonify::trace {
namespace {

constexpr std::size_t kRowsTogether = 4;
constexpr double kBlindShare = 0.05;  // rows of a direction where the first look met nothing, over those of others

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

void fill_strata(std::span<const double> sine_edges, std::span<const double> across_edges_rad,
                 const random::Stream& jitter, std::uint64_t ping, std::vector<Ray>& rays) {
  const std::size_t along = sine_edges.size() - 1, across = across_edges_rad.size() - 1;
  rays.resize(along * across);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const std::size_t first_row = i / (along * kRowsTogether) * kRowsTogether;
    const std::size_t rows = std::min(kRowsTogether, across - first_row);
    const std::size_t a = (i - first_row * along) / rows, b = first_row + (i - first_row * along) % rows;
    const auto bits = jitter.bits(ping, i);
    const double du = sine_edges[a + 1] - sine_edges[a];
    const double dphi = across_edges_rad[b + 1] - across_edges_rad[b];
    const double u = sine_edges[a] + du * (0x1p-32 * bits[0]);
    const double phi = across_edges_rad[b] + dphi * (0x1p-32 * bits[1]);
    rays[i] = {direction_of(u, phi).cast<float>(), static_cast<float>(du * dphi)};
  }
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

void Fan::fill(const random::Stream& jitter, std::uint64_t ping, std::vector<Ray>& rays) const {
  fill_strata(sine_edges_, across_edges_rad_, jitter, ping, rays);
}

SideFan::SideFan(const SideFanShape& shape) : shape_(shape) {
  if (shape.along < 1 || shape.across < 1 || shape.look < 2 || !(shape.transmit_length_in_waves > 0.0) ||
      !(shape.along_reach > 0.0)) {
    throw std::invalid_argument("a side fan needs rays, looks, an array length and a reach, all positive");
  }
  if (!(-std::numbers::pi < shape.from_rad && shape.from_rad < shape.to_rad && shape.to_rad < std::numbers::pi)) {
    throw std::invalid_argument("a side fan goes from one angle to a greater one, both between -180 and 180 degrees");
  }
  sine_edges_ = sine_edges(shape.transmit_length_in_waves, shape.along_reach, shape.along);
  const double step_rad = (shape.to_rad - shape.from_rad) / shape.look;
  for (int i = 0; i < shape.look; ++i) {
    look_.push_back({direction_of(0.0, shape.from_rad + (i + 0.5) * step_rad).cast<float>(), 0.0F});
  }
}

/// Rows by look, then the angles at which each row begins.
void SideFan::lay_rows(std::span<const float> met_range_m) {
  const std::size_t looks = look_.size();
  const auto met = [&](std::size_t i) { return i < looks && met_range_m[i] > 0.0F; };  // i may wrap below 0
  const auto step_m = [&](std::size_t i, std::size_t j) {
    return met(i) && met(j) ? std::abs(static_cast<double>(met_range_m[i]) - met_range_m[j]) : 0.0;
  };
  extent_m_.resize(looks);
  rows_.resize(looks);
  double extents_m = 0.0, angles = 0.0;
  for (std::size_t i = 0; i < looks; ++i) {
    // Half way to each neighbour. Where the answers end they go on as before, up to half a look farther.
    const double before = step_m(i - 1, i), after = step_m(i, i + 1);
    extent_m_[i] = met(i) ? (met(i - 1) && met(i + 1) ? 0.5 * (before + after) : before + after)
                          : 0.5 * (step_m(i - 2, i - 1) + step_m(i + 1, i + 2));
    rows_[i] = met(i - 1) || met(i) || met(i + 1) ? 1.0 : kBlindShare;
    extents_m += extent_m_[i];
    angles += rows_[i];
  }
  const double by_range = extents_m > 0.0 ? shape_.range_share * shape_.across / extents_m : 0.0;
  const double by_angle = (extents_m > 0.0 ? 1.0 - shape_.range_share : 1.0) * shape_.across / angles;
  for (std::size_t i = 0; i < looks; ++i) rows_[i] = by_range * extent_m_[i] + by_angle * rows_[i];

  const double look_rad = (shape_.to_rad - shape_.from_rad) / static_cast<double>(looks);
  across_edges_rad_.clear();
  std::size_t look = 0;
  double begun = 0.0;  // rows before this look
  for (int row = 0; row < shape_.across; ++row) {
    while (look + 1 < looks && begun + rows_[look] <= row) begun += rows_[look++];
    const double part = std::min((row - begun) / rows_[look], 1.0);
    across_edges_rad_.push_back(shape_.from_rad + (static_cast<double>(look) + part) * look_rad);
  }
  across_edges_rad_.push_back(shape_.to_rad);
}

void SideFan::fill(std::span<const float> met_range_m, const random::Stream& jitter, std::uint64_t ping,
                   std::vector<Ray>& rays) {
  if (met_range_m.size() != look_.size()) throw std::invalid_argument("a side fan needs one range per look");
  lay_rows(met_range_m);
  fill_strata(sine_edges_, across_edges_rad_, jitter, ping, rays);
}

}  // namespace ensonify::trace

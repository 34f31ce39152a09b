#include "kernels/survey/uncertainty/relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace ensonify::uncertainty {
namespace {

constexpr std::array kFourth{1.0, -4.0, 6.0, -4.0, 1.0};  // difference: weights of heights a footprint apart
constexpr int kReach = 2;                                 // footprints to either side
constexpr int kPerWidth = 16, kHalfWindow = 12;           // places of a footprint: 1.5 half-power widths

struct Height {
  double height_m, noise_m2;
};

/// Of the rising points `order` of the profile, at a place; empty outside.
std::optional<Height> height_at(std::span<const ProfilePoint> profile, const std::vector<std::size_t>& order,
                                double across_m) {
  const auto after = std::ranges::lower_bound(order, across_m, {}, [&](std::size_t i) { return profile[i].across_m; });
  if (after == order.end() || (after == order.begin() && across_m < profile[*after].across_m)) return std::nullopt;
  const ProfilePoint& b = profile[*after];
  if (after == order.begin()) return Height{b.height_m, b.noise_sd_m * b.noise_sd_m};
  const ProfilePoint& a = profile[*std::prev(after)];
  const double share = (across_m - a.across_m) / (b.across_m - a.across_m);
  return Height{a.height_m + share * (b.height_m - a.height_m),
                std::pow((1.0 - share) * a.noise_sd_m, 2) + std::pow(share * b.noise_sd_m, 2)};
}

/// Of a beam's power, sum 1.
std::vector<double> window() {
  constexpr double kHalfPower = 0.8859;  // of sinc^2: its width
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = -kHalfWindow; i <= kHalfWindow; ++i) {
    const double x = std::numbers::pi * kHalfPower * i / kPerWidth;
    sum += weights.emplace_back(i == 0 ? 1.0 : std::pow(std::sin(x) / x, 2));
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

/// Sums of products of weights so many places apart, either way.
std::vector<double> by_distance(const std::vector<double>& weights) {
  std::vector<double> sums(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) sums[i - j] += (i == j ? 1.0 : 2.0) * weights[i] * weights[j];
  }
  return sums;
}

/// Places and widths between neighbours in a footprint, across and along.
double distance_power(std::size_t across, std::size_t along, double aspect, double hurst) {
  const double x = static_cast<double>(across) / kPerWidth, y = aspect * static_cast<double>(along) / kPerWidth;
  return std::pow(x * x + y * y, hurst);
}

/// Sum over all pairs of places: of differences' variance times both weights.
double pairs(const std::vector<double>& across, const std::vector<double>& along, double aspect, double hurst) {
  double sum = 0.0;
  for (std::size_t i = 0; i < across.size(); ++i) {
    for (std::size_t j = 0; j < along.size(); ++j) {
      sum += across[i] * along[j] * distance_power(i, j, aspect, hurst);
    }
  }
  return sum;
}

}  // namespace

std::vector<double> squared_bends_m2(std::span<const ProfilePoint> profile) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr Height kUnknown{kNan, kNan};
  std::vector<double> bends(profile.size(), kNan);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (order.empty() || profile[i].across_m > profile[order.back()].across_m) order.push_back(i);
  }
  for (const std::size_t i : order) {
    const ProfilePoint& p = profile[i];
    double bend_m = 0.0, noise_m2 = 0.0;
    for (std::size_t k = 0; k < kFourth.size(); ++k) {
      const double weight = kFourth[k], steps = static_cast<double>(k) - kReach;
      const auto there = height_at(profile, order, p.across_m + steps * p.footprint_m).value_or(kUnknown);
      bend_m += weight * there.height_m;
      noise_m2 += weight * weight * there.noise_m2;
    }
    bends[i] = bend_m * bend_m - noise_m2;
  }
  return bends;
}

double unresolved_share(double hurst, double aspect) {
  // Variance of a sum of heights with weights that add up to 0: -1/2 sum_ij a_i a_j D(|x_i - x_j|), D the variance of
  // differences. Weights are products of one across and one along the track, and so are their sums by distance.
  const std::vector<double> beam = window(), along = by_distance(beam);
  std::vector<double> difference(static_cast<std::size_t>(2 * (kReach * kPerWidth + kHalfWindow) + 1));
  for (std::size_t mean = 0; mean < kFourth.size(); ++mean) {
    for (std::size_t i = 0; i < beam.size(); ++i) difference[mean * kPerWidth + i] += kFourth[mean] * beam[i];
  }
  double to_middle = 0.0;
  for (std::size_t i = 0; i < beam.size(); ++i) {
    for (std::size_t j = 0; j < beam.size(); ++j) {
      const auto off = [](std::size_t k) { return k > kHalfWindow ? k - kHalfWindow : kHalfWindow - k; };
      to_middle += beam[i] * beam[j] * distance_power(off(i), off(j), aspect, hurst);
    }
  }
  const double unresolved = to_middle - 0.5 * pairs(along, along, aspect, hurst);
  return unresolved / (-0.5 * pairs(by_distance(difference), along, aspect, hurst));
}

}  // namespace ensonify::uncertainty

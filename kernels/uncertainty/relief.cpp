#include "kernels/uncertainty/relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace ensonify::uncertainty {
namespace {

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

}  // namespace

std::vector<double> squared_bends_m2(std::span<const ProfilePoint> profile) {
  std::vector<double> bends(profile.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (order.empty() || profile[i].across_m > profile[order.back()].across_m) order.push_back(i);
  }
  for (const std::size_t i : order) {
    const ProfilePoint& p = profile[i];
    const auto low = height_at(profile, order, p.across_m - p.footprint_m);
    const auto high = height_at(profile, order, p.across_m + p.footprint_m);
    if (!low || !high) continue;
    const double bend_m = low->height_m - 2.0 * p.height_m + high->height_m;
    bends[i] = bend_m * bend_m - low->noise_m2 - 4.0 * p.noise_sd_m * p.noise_sd_m - high->noise_m2;
  }
  return bends;
}

double unresolved_share(double hurst) {
  // Variance of a sum of heights with weights that add up to 0: -1/2 sum_ij a_i a_j D(|x_i - x_j|). Places in steps of
  // a sixteenth of a footprint.
  constexpr int kPerFootprint = 16, kHalfWindow = 12, kReach = kPerFootprint + kHalfWindow;
  constexpr std::size_t kPlaces = 2 * kReach + 1;
  std::array<double, 2 * kHalfWindow + 1> window{};
  double sum = 0.0;
  for (int i = -kHalfWindow; i <= kHalfWindow; ++i) {
    constexpr double kHalfPower = 0.8859;  // of sinc^2: its width
    const double x = std::numbers::pi * kHalfPower * i / kPerFootprint;
    sum += window[static_cast<std::size_t>(i + kHalfWindow)] = i == 0 ? 1.0 : std::pow(std::sin(x) / x, 2);
  }
  const auto variance = [&](std::array<double, 3> means, double point) {
    std::array<double, kPlaces> weights{};
    weights[kReach] = point;
    for (int mean = 0; mean < 3; ++mean) {
      for (int i = 0; i <= 2 * kHalfWindow; ++i) {
        weights[static_cast<std::size_t>(mean * kPerFootprint + i)] +=
            means[static_cast<std::size_t>(mean)] * window[static_cast<std::size_t>(i)] / sum;
      }
    }
    double total = 0.0;
    for (std::size_t i = 0; i < kPlaces; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        total -= weights[i] * weights[j] * std::pow(static_cast<double>(i - j) / kPerFootprint, 2.0 * hurst);
      }
    }
    return total;
  };
  return variance({0.0, 1.0, 0.0}, -1.0) / variance({1.0, -2.0, 1.0}, 0.0);
}

}  // namespace ensonify::uncertainty

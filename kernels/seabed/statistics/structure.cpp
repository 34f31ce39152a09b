#include "kernels/seabed/statistics/structure.h"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "kernels/seabed/statistics/line_fit.h"

namespace ensonify::relief_statistics {
namespace {

/// Mean of |difference|^q for q = 1, 2, 3 or a power of the caller's.
template <class Power>
auto mean_over_pairs(const Surface& surface, int lag, const Power& power) {
  decltype(power(0.0)) sum{};
  double pairs = 0.0;
  const auto add = [&](float a, float b) {
    const double difference = std::abs(static_cast<double>(a) - static_cast<double>(b));
    if (std::isnan(difference)) return;
    sum += power(difference);
    pairs += 1.0;
  };
  for (int j = 0; j < surface.rows; ++j) {
    for (int i = 0; i + lag < surface.columns; ++i) add(surface.at(i, j), surface.at(i + lag, j));
    if (j + lag >= surface.rows) continue;
    for (int i = 0; i < surface.columns; ++i) add(surface.at(i, j), surface.at(i, j + lag));
  }
  return pairs > 0.0 ? sum * (1.0 / pairs) : sum * std::numeric_limits<double>::quiet_NaN();
}

/// Three sums side by side.
struct Powers {
  double first = 0.0, second = 0.0, third = 0.0;
  Powers& operator+=(const Powers& other) {
    first += other.first;
    second += other.second;
    third += other.third;
    return *this;
  }
  Powers operator*(double by) const { return {first * by, second * by, third * by}; }
};

}  // namespace

double structure_function(const Surface& surface, int lag_cells, double order) {
  check(surface);
  return mean_over_pairs(surface, lag_cells, [&](double x) { return std::pow(x, order); });
}

ScalingExponents scaling_exponents(const Surface& surface) {
  check(surface);
  constexpr std::array<int, 6> kLags{1, 2, 4, 8, 16, 32};
  if (surface.columns <= kLags.back() || surface.rows <= kLags.back()) {
    throw std::invalid_argument("scaling exponents: the surface has " + std::to_string(surface.columns) + " x " +
                                std::to_string(surface.rows) + " posts, allowed: more than 32 each way");
  }
  std::array<double, kLags.size()> x, first, second, third;
  for (std::size_t i = 0; i < kLags.size(); ++i) {
    const Powers mean = mean_over_pairs(surface, kLags[i], [](double d) { return Powers{d, d * d, d * d * d}; });
    if (!(mean.first > 0.0)) throw std::invalid_argument("scaling exponents: the surface is level, or all holes");
    x[i] = std::log(kLags[i]);
    first[i] = std::log(mean.first);
    second[i] = std::log(mean.second);
    third[i] = std::log(mean.third);
  }
  return {fit_line(x, first).slope, fit_line(x, second).slope, fit_line(x, third).slope};
}

}  // namespace ensonify::relief_statistics

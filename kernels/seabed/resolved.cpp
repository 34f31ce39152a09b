#include "kernels/seabed/resolved.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace ensonify::seabed {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSteps = 180;  // of half a degree
constexpr double kStep_rad = 0.5 * kPi / kSteps;
constexpr int kRounds = 8;
constexpr double kMost = 1.3816;          // 6 dB, natural logarithm
constexpr double kSteepest_square = 0.5;  // half of a rough rock's facets are steeper; the scheme does not settle there

/// Natural logarithms at every half degree of grazing, linear between.
using Curve = std::array<double, kSteps + 1>;

double at(const Curve& curve, double grazing_rad) {
  const double place = std::clamp(grazing_rad / kStep_rad, 0.0, static_cast<double>(kSteps));
  const auto below = std::min(static_cast<std::size_t>(place), static_cast<std::size_t>(kSteps - 1));
  return std::lerp(curve[below], curve[below + 1], place - static_cast<double>(below));
}

/// Logarithm, of anything that a law may return.
double log_of(double strength) { return std::log(std::max(strength, 1e-30)); }

/// Slopes towards the sonar and across, all as likely as each other.
struct Slope {
  double towards, across;
};

std::vector<Slope> slopes_of(double mean_square) {
  constexpr int kSizes = 24, kDirections = 24;  // half the circle: across is the same to both sides
  std::vector<Slope> slopes;
  for (int i = 0; i < kSizes; ++i) {
    const double size = std::sqrt(-mean_square * std::log1p(-(i + 0.5) / kSizes));  // Rayleigh's distribution
    for (int j = 0; j < kDirections; ++j) {
      const double direction = kPi * (j + 0.5) / kDirections;
      slopes.push_back({size * std::cos(direction), size * std::sin(direction)});
    }
  }
  return slopes;
}

/// Logarithm of what facets of this law return from a unit of the plane's area, seen at a grazing angle from it.
double tilted(const Curve& facets, const std::vector<Slope>& slopes, double grazing_rad) {
  const double sine = std::sin(grazing_rad), cosine = std::cos(grazing_rad);
  double sum = 0.0;
  for (const Slope& slope : slopes) {
    const double area = std::sqrt(1.0 + slope.towards * slope.towards + slope.across * slope.across);
    const double sin_on_facet = (sine + slope.towards * cosine) / area;
    if (sin_on_facet > 0.0) sum += area * std::exp(at(facets, std::asin(std::min(sin_on_facet, 1.0))));
  }
  return log_of(sum / static_cast<double>(slopes.size()));
}

}  // namespace

Law law_of_facets(const Law& whole, double mean_square_slope) {
  if (!(mean_square_slope >= 0.0 && mean_square_slope <= kSteepest_square)) {
    throw std::invalid_argument("mean square slope of facets " + std::to_string(mean_square_slope) +
                                ": allowed is 0 to " + std::to_string(kSteepest_square));
  }
  if (mean_square_slope == 0.0) return whole;
  const auto slopes = slopes_of(mean_square_slope);
  Curve plane{}, change{};
  for (std::size_t i = 0; i < plane.size(); ++i) {
    // Laws fall to nothing at 0: there the curve would be steeper than half a degree can tell.
    plane[i] = log_of(whole(std::max(kStep_rad * static_cast<double>(i), 0.1 * kStep_rad)));
  }
  for (int round = 0; round < kRounds; ++round) {
    Curve facets;
    for (std::size_t i = 0; i < facets.size(); ++i) facets[i] = plane[i] + change[i];
    for (std::size_t i = 0; i < facets.size(); ++i) {
      const double excess = tilted(facets, slopes, kStep_rad * static_cast<double>(i)) - plane[i];
      change[i] = std::clamp(change[i] - excess, -kMost, kMost);
    }
  }
  return [whole, change](double grazing_rad) { return whole(grazing_rad) * std::exp(at(change, grazing_rad)); };
}

}  // namespace ensonify::seabed

#include "kernels/seabed/resolved.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace ensonify::seabed {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSteps = 180;  // of half a degree
constexpr double kStep_rad = 0.5 * kPi / kSteps;
constexpr int kRounds = 8;
constexpr double kMost = 1.3816;          // 6 dB, as a natural logarithm
constexpr double kSteepest_square = 0.5;  // half of a rough rock's facets are steeper; the scheme does not settle there

/// At every half degree of grazing, linear between.
using Curve = std::array<double, kSteps + 1>;

struct Place {
  std::size_t below;
  double part;  // of the step
};

Place place_of(double grazing_rad) {
  const double place = std::clamp(grazing_rad / kStep_rad, 0.0, static_cast<double>(kSteps));
  const auto below = std::min(static_cast<std::size_t>(place), static_cast<std::size_t>(kSteps - 1));
  return {below, place - static_cast<double>(below)};
}

double at(const Curve& curve, double grazing_rad) {
  const auto [below, part] = place_of(grazing_rad);
  return std::lerp(curve[below], curve[below + 1], part);
}

/// Slopes towards the sonar and across, all as likely as each other.
struct Slope {
  double towards, across;
};

std::vector<Slope> slopes_of(double mean_square) {
  constexpr int kSizes = 20, kDirections = 20;  // half the circle: across is the same to both sides
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

/// Calls visit(grazing angle from a facet, its area per unit of the plane's) for every facet that faces the sound.
template <class Visit>
void for_facets(const std::vector<Slope>& slopes, double grazing_rad, const Visit& visit) {
  const double sine = std::sin(grazing_rad), cosine = std::sqrt(1.0 - sine * sine);
  for (const Slope& slope : slopes) {
    const double area = std::sqrt(1.0 + slope.towards * slope.towards + slope.across * slope.across);
    const double sin_on_facet = (sine + slope.towards * cosine) / area;
    if (sin_on_facet > 0.0) visit(std::asin(std::min(sin_on_facet, 1.0)), area);
  }
}

/// What facets return from a unit of the plane's area is a sum of their law's values: the weights of these, by the
/// grazing angle from the plane.
std::vector<Curve> weights_of(double mean_square_slope) {
  const auto slopes = slopes_of(mean_square_slope);
  std::vector<Curve> weights(kSteps + 1, Curve{});
  for (std::size_t i = 0; i < weights.size(); ++i) {
    for_facets(slopes, kStep_rad * static_cast<double>(i), [&](double on_facet_rad, double area) {
      const auto [below, part] = place_of(on_facet_rad);
      weights[i][below] += area * (1.0 - part) / static_cast<double>(slopes.size());
      weights[i][below + 1] += area * part / static_cast<double>(slopes.size());
    });
  }
  return weights;
}

}  // namespace

Law law_of_facets(const Law& whole, double mean_square_slope) {
  if (!(mean_square_slope >= 0.0 && mean_square_slope <= kSteepest_square)) {
    throw std::invalid_argument("mean square slope of facets " + std::to_string(mean_square_slope) +
                                ": allowed is 0 to " + std::to_string(kSteepest_square));
  }
  if (mean_square_slope == 0.0) return whole;
  const auto weights = weights_of(mean_square_slope);
  Curve plane{}, facets{}, change{};  // change: natural logarithm
  for (std::size_t i = 0; i < plane.size(); ++i) {
    // Laws fall to nothing at 0: there the curve would be steeper than half a degree can give.
    plane[i] = std::max(whole(std::max(kStep_rad * static_cast<double>(i), 0.1 * kStep_rad)), 1e-30);
  }
  facets = plane;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < plane.size(); ++i) {
      const double tilted = std::inner_product(facets.begin(), facets.end(), weights[i].begin(), 0.0);
      change[i] = std::clamp(change[i] - std::log(tilted / plane[i]), -kMost, kMost);
    }
    for (std::size_t i = 0; i < plane.size(); ++i) facets[i] = plane[i] * std::exp(change[i]);
  }
  return [whole, change](double grazing_rad) { return whole(grazing_rad) * std::exp(at(change, grazing_rad)); };
}

double mean_over_facets(const Law& facets, double mean_square_slope, double grazing_rad) {
  const auto slopes = slopes_of(mean_square_slope);
  double sum = 0.0;
  for_facets(slopes, grazing_rad, [&](double on_facet_rad, double area) { sum += area * facets(on_facet_rad); });
  return sum / static_cast<double>(slopes.size());
}

}  // namespace ensonify::seabed

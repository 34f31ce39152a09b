#include "kernels/seabed/law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "kernels/seabed/backscatter.h"

namespace ensonify::seabed {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct LawOf {
  double frequency_hz;
  double sound_speed_mps;

  Law operator()(const SedimentParameters& sediment) const {
    return SedimentBackscatter(sediment, frequency_hz, sound_speed_mps);
  }

  Law operator()(const CappedSediment& capped) const {
    const SedimentBackscatter law(capped.sediment, frequency_hz, sound_speed_mps);
    const double diffuse = std::norm(reflection_coefficient(capped.sediment, 90.0 * kDegree)) / std::numbers::pi;
    return [=](double grazing_rad) {
      const auto part = law.parts(grazing_rad);
      const double sine = std::sin(std::clamp(grazing_rad, 0.001 * kDegree, 90.0 * kDegree));
      const double excess = std::max(1.0, part.roughness / (diffuse * sine * sine));
      const double taken = std::clamp((75.0 - grazing_rad / kDegree) / 15.0, 0.0, 1.0);  // share of its dB
      return part.roughness * std::pow(excess, -taken) + part.volume;
    };
  }

  Law operator()(const MeshedSediment& meshed) const {
    return law_of_facets(std::visit(*this, meshed.whole), meshed.mean_square_slope);
  }

  Law operator()(const Lambert& lambert) const {
    return [=](double grazing_rad) {
      return lambert_backscatter(lambert.mu_db, std::sin(std::clamp(grazing_rad, 0.0, 90.0 * kDegree)));
    };
  }

  Law operator()(const Gsab& curve) const {
    return [=](double grazing_rad) { return gsab_backscatter(curve, grazing_rad); };
  }

  Law operator()(const Material& material) const {
    return [=](double grazing_rad) { return material_backscatter(material, grazing_rad); };
  }

  Law operator()(const Tissue& tissue) const {
    const double mu = lambert_of_target_strength(tissue.target_strength_db, tissue.surface_area_m2);
    return (*this)(Lambert{10.0 * std::log10(mu)});
  }
};

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

double gsab_backscatter(const Gsab& curve, double grazing_rad) {
  if (!(curve.specular_width_rad > 0.0 && curve.transition_width_rad > 0.0)) {
    throw std::invalid_argument("GSAB widths " + std::to_string(curve.specular_width_rad) + " and " +
                                std::to_string(curve.transition_width_rad) + " rad: allowed is above 0");
  }
  const double grazing = std::clamp(grazing_rad, 0.0, std::numbers::pi / 2.0);
  const double incidence = std::numbers::pi / 2.0 - grazing;
  const auto bell = [&](double width) { return std::exp(-0.5 * incidence * incidence / (width * width)); };
  return curve.specular * bell(curve.specular_width_rad) +
         curve.diffuse * std::pow(std::sin(grazing), curve.diffuse_exponent) +
         curve.transition * bell(curve.transition_width_rad);
}

Law law_of(const Scatterer& scatterer, double frequency_hz, double sound_speed_mps) {
  return std::visit(LawOf{frequency_hz, sound_speed_mps}, scatterer);
}

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

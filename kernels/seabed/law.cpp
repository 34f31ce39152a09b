#include "kernels/seabed/law.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "kernels/seabed/backscatter.h"
#include "kernels/seabed/lambert.h"
#include "kernels/seabed/reflection.h"
#include "kernels/seabed/resolved.h"

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

}  // namespace ensonify::seabed

#include "kernels/seabed/gsab.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace ensonify::seabed {

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

}  // namespace ensonify::seabed

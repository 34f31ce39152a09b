#include "kernels/seabed/reflection.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ensonify::seabed {

std::complex<double> reflection_coefficient(const SedimentParameters& sediment, double grazing_rad) {
  const double theta = std::clamp(grazing_rad, 0.0, std::numbers::pi / 2.0);
  const double cosine = std::cos(theta);
  const std::complex<double> kappa = std::complex<double>(1.0, sediment.loss) / sediment.sound_speed_ratio;
  const std::complex<double> P = std::sqrt(kappa * kappa - cosine * cosine);  // principal root
  const std::complex<double> y = sediment.density_ratio * std::sin(theta) / P;
  return (y - 1.0) / (y + 1.0);
}

double forward_loss_db(const SedimentParameters& sediment, double grazing_rad) {
  return -20.0 * std::log10(std::abs(reflection_coefficient(sediment, grazing_rad)));
}

}  // namespace ensonify::seabed

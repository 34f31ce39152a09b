#include "kernels/seabed/lambert.h"

#include <cmath>

namespace ensonify::seabed {

double lambert_backscatter(double mu_db, double sin_grazing) {
  return std::pow(10.0, 0.1 * mu_db) * sin_grazing * sin_grazing;
}

double lambert_strength_db(double mu_db, double sin_grazing) { return mu_db + 20.0 * std::log10(sin_grazing); }

}  // namespace ensonify::seabed

#include "kernels/water/pressure.h"

#include <cmath>

namespace ensonify::water {

double sea_pressure_pa(double depth_m, double latitude_rad) {
  // [Saunders1981]: z = (1 - c1) p - c2 p^2, p in dbar, solved for p.
  const double sin_latitude = std::sin(latitude_rad);
  const double c1 = 5.92e-3 + 5.25e-3 * sin_latitude * sin_latitude;
  const double c2 = 2.21e-6;
  const double p_dbar = ((1.0 - c1) - std::sqrt((1.0 - c1) * (1.0 - c1) - 4.0 * c2 * depth_m)) / (2.0 * c2);
  return p_dbar * 1e4;
}

}  // namespace ensonify::water

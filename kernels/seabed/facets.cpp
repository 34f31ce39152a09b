#include "kernels/seabed/facets.h"

#include <cmath>
#include <numbers>

namespace ensonify::seabed {

double facet_backscatter(double sin_grazing, double mean_square_slope) {
  const double sin_squared = sin_grazing * sin_grazing;
  if (!(sin_squared > 1e-30)) return 0.0;                        // the limit
  const double tan_squared = (1.0 - sin_squared) / sin_squared;  // of incidence
  return std::exp(-tan_squared / mean_square_slope) /
         (4.0 * std::numbers::pi * mean_square_slope * sin_squared * sin_squared);
}

}  // namespace ensonify::seabed

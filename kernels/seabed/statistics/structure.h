#pragma once

#include "kernels/seabed/statistics/surface.h"

namespace ensonify::relief_statistics {

/// Mean of |z(a) - z(b)|^order over all pairs of posts `lag_cells` apart along a row or a column; holes are left out.
/// NaN if there is no pair. For an isotropic surface and order 2 this is the structure function D(r).
double structure_function(const Surface& surface, int lag_cells, double order);

/// Exponents of S_q(r) ~ r^zeta(q), q = 1, 2, 3: least squares of ln S over ln r at lags 1, 2, 4 ... 32 cells.
struct ScalingExponents {
  double zeta_1 = 0.0;
  double zeta_2 = 0.0;
  double zeta_3 = 0.0;

  /// 0 for one Gaussian law everywhere (zeta(q) = q H); the intermittency of a lognormal cascade.
  double k2() const { return 2.0 * zeta_1 - zeta_2; }
};

/// Throws std::invalid_argument unless the surface is more than 32 posts wide and high, and not level.
ScalingExponents scaling_exponents(const Surface& surface);

}  // namespace ensonify::relief_statistics

#pragma once

#include <cstdint>

#include "kernels/base/random/stream.h"
#include "kernels/seabed/statistics/surface.h"

namespace ensonify::relief_statistics {

/// Fractional Brownian relief with exactly D(r) = r^(2 H), r in posts, on `posts` x `posts` posts spaced 1 m: the
/// yardstick that says how far an estimator is off.
///
/// Stein's intrinsic embedding [Stein2002]: a stationary field on a torus whose covariance has rho^(2H) to rho = 1 (rho
/// = r over the diagonal) and falls to 0 smoothly, at once for H <= 0.75 and at rho = 2 above, plus a random tilt; no
/// lattice effects, no approximation but float's rounding. Surfaces of different `number` are independent. Throws
/// std::invalid_argument for H outside (0, 0.95] or posts outside [2, 2048].
Surface exact_fbm(double hurst, int posts, const random::Stream& stream, std::uint64_t number);

/// Mean of |z(a) - z(b)|^order over all pairs of posts `lag_cells` apart along a row or a column; holes are left out.
/// NaN if there is no pair. For an isotropic surface and order 2 this is the structure function D(r).
double structure_function(const Surface& surface, int lag_cells, double order);

}  // namespace ensonify::relief_statistics

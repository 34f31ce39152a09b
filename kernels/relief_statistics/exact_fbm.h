#pragma once

#include <cstdint>

#include "kernels/random/stream.h"
#include "kernels/relief_statistics/surface.h"

namespace ensonify::relief_statistics {

/// Fractional Brownian relief with exactly D(r) = r^(2 H), r in posts, on `posts` x `posts` posts spaced 1 m: the
/// yardstick that says how far an estimator is off.
///
/// Stein's intrinsic embedding [Stein2002] for H <= 0.75: a stationary field of covariance
/// 1 - H - rho^(2H) + H rho^2 (rho = r over the diagonal, 0 beyond it) on a torus, plus a random tilt; no lattice
/// effects, no approximation but float's rounding. Surfaces of different `number` are independent.
/// Throws std::invalid_argument for H outside (0, 0.75] or posts outside [2, 2048].
Surface exact_fbm(double hurst, int posts, const random::Stream& stream, std::uint64_t number);

}  // namespace ensonify::relief_statistics

#pragma once

#include <complex>
#include <cstdint>
#include <span>

#include "kernels/base/random/stream.h"

namespace ensonify::random {

/// Adds complex Gaussians, `sd` per component, to many numbers at once; about five times as fast as normal_pair.
///
/// Number k gets words 2 (k % 2) and 2 (k % 2) + 1 of stream.bits(a, b + k / 2) through Box and Muller's transform
/// [BoxMuller1958] in float, with polynomials (not the system's functions) for logarithm, sine and cosine
/// [Moshier1989]: relative error below 1e-6, the same bits on every machine. At most 6.7 sd.
void add_gaussian(const Stream& stream, std::uint64_t a, std::uint64_t b, float sd,
                  std::span<std::complex<float>> numbers);

}  // namespace ensonify::random

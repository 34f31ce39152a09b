#pragma once

#include <complex>
#include <span>

#include "kernels/base/fft/transform.h"

namespace ensonify::fft {

/// The two-dimensional transform of `rows` rows of `columns` numbers, in place, not scaled. `columns` must be even and
/// the first number must lie on a multiple of 16 bytes.
void transform_plane(std::span<std::complex<float>> numbers, int columns, int rows, Transform::Sign sign);

}  // namespace ensonify::fft

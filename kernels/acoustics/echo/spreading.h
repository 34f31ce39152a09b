#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace ensonify::echo {

/// Spreading of a number between the points of a regular grid, and its interpolation, so that a
/// Fourier transform of the grid is that of the number: the window of a non-uniform FFT [Barnett2019].
///
/// phi(z) = exp(beta (sqrt(1 - (2 z / w)^2) - 1)), w = kWidth = 6 points wide, beta = 2.30 w for a grid twice as fine
/// as the transform needs. Each of the two steps errs by about 1e-6 of the largest number.
class Spreading {
 public:
  static constexpr int kWidth = 6;
  /// Weights of kWidth neighbours, each twice: for (re, im) pairs.
  using Taps = Eigen::Array<float, 2 * kWidth, 1>;

  Spreading();

  /// The taps of a number at `offset` (0..1) beyond the third of its six points.
  Taps taps(float offset) const {
    const float x = offset * kSteps;
    const auto i = static_cast<std::size_t>(x);
    return table_[i] + (x - static_cast<float>(i)) * (table_[i + 1] - table_[i]);
  }

  /// Integral of phi(z) e^(i phase z) dz: what the transform at `phase` rad per point has to be divided by.
  static double transform(double phase);

 private:
  static constexpr int kSteps = 256;
  std::vector<Taps> table_;
};

}  // namespace ensonify::echo

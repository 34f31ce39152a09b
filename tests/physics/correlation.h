#pragma once

#include <cstddef>
#include <vector>

namespace ensonify::physics {

/// Correlation of the powers of two series of amplitudes of the same mean: |coherence|^2 of Gaussian fields.
inline double power_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0, square = 0.0, product = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double p = a[i] * a[i], q = b[i] * b[i];
    sum += 0.5 * (p + q), square += 0.5 * (p * p + q * q), product += p * q;
  }
  const double n = static_cast<double>(a.size()), mean = sum / n;
  return (product / n - mean * mean) / (square / n - mean * mean);
}

}  // namespace ensonify::physics

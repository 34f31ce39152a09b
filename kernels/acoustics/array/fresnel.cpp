#include "kernels/acoustics/array/fresnel.h"

#include <cmath>
#include <numbers>

namespace ensonify::array {
namespace {

using Complex = std::complex<double>;

constexpr double kPi = std::numbers::pi;
constexpr double kSeriesEnds = 2.0;  // where 16 levels of the fraction are good to 4e-13
constexpr int kLevels = 16;

/// Sum of (i pi x^2 / 2)^n x / (n! (2 n + 1)) [Abramowitz1964, 7.3.11 and 7.3.13].
Complex series(double x) {
  const Complex step(0.0, 0.5 * kPi * x * x);
  Complex term = x, sum = x;
  for (int n = 1; std::abs(term) > 1e-17; ++n) {
    term *= step / static_cast<double>(n);
    sum += term / (2.0 * n + 1.0);
  }
  return sum;
}

/// From erfc(z) with z = sqrt(pi) / 2 (1 - i) x, by its continued fraction, even part [Abramowitz1964, 7.1.14, 7.3.22].
Complex fraction(double x) {
  const Complex twice_z2(0.0, -kPi * x * x);
  Complex tail = twice_z2 + (4.0 * kLevels + 1.0);
  for (int k = kLevels; k > 0; --k) tail = twice_z2 + (4.0 * k - 3.0) - (2.0 * k - 1.0) * (2.0 * k) / tail;
  const Complex erfc = std::polar(1.0, 0.5 * kPi * x * x) * Complex(x, -x) / tail;
  return Complex(0.5, 0.5) * (1.0 - erfc);
}

}  // namespace

std::complex<double> fresnel_integral(double x) {
  if (std::abs(x) < kSeriesEnds) return series(x);
  return x > 0.0 ? fraction(x) : -fraction(-x);
}

}  // namespace ensonify::array

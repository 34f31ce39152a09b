#include "kernels/acoustics/array/near_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/acoustics/array/line.h"

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

constexpr double kStraight = 1e-4;  // |b| of a front that counts as straight: pi b / 12 = 3e-5 of the amplitude

}  // namespace

std::complex<double> fresnel_integral(double x) {
  if (std::abs(x) < kSeriesEnds) return series(x);
  return x > 0.0 ? fraction(x) : -fraction(-x);
}

std::complex<double> near_field_amplitude(const LineArray& array, double wavelength_m, double sine, double sin_steer,
                                          double range_m, double focus_m) {
  const double k = 2.0 * std::numbers::pi / wavelength_m;
  const double tilt = k * (sine - sin_steer);
  const double bend = 0.5 * k * ((1.0 - sine * sine) / range_m - (1.0 - sin_steer * sin_steer) / focus_m);
  std::complex<double> sum = 0.0;
  double sum_of_weights = 0.0;
  double x = -0.5 * array.spacing_m * (array.elements() - 1);
  for (const double w : array.weights) {
    sum += std::polar(1.0, x * (tilt - x * bend)) * w;
    sum_of_weights += w;
    x += array.spacing_m;
  }
  return sum * (sinc(array.element_length_m / wavelength_m * sine) / sum_of_weights);
}

std::complex<double> near_field_line_amplitude(double length_m, double wavelength_m, double sine, double range_m,
                                               double focus_m) {
  const double s = sine * length_m / wavelength_m;
  const double signed_bend = length_m * length_m / wavelength_m * ((1.0 - sine * sine) / range_m - 1.0 / focus_m);
  const double b = std::abs(signed_bend);
  if (b < kStraight) return sinc(s);
  // -b t^2 / 2 + s t = -b / 2 (t - s / b)^2 + s^2 / (2 b)
  const double scale = std::sqrt(2.0 * b);
  const auto span = fresnel_integral(scale * (0.5 - s / b)) - fresnel_integral(scale * (-0.5 - s / b));
  const std::complex<double> amplitude = std::polar(1.0 / scale, std::numbers::pi * s * s / b) * std::conj(span);
  return signed_bend > 0.0 ? amplitude : std::conj(amplitude);  // the line is symmetrical in t
}

double near_field_range_m(const LineArray& array, double wavelength_m) {
  return array.length_m() * array.length_m() / wavelength_m;
}

}  // namespace ensonify::array

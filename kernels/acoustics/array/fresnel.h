#pragma once

#include <complex>

namespace ensonify::array {

/// C(x) + i S(x), the integral of exp(i pi v^2 / 2) dv over 0..x [Abramowitz1964, ch. 7.3]. Absolute error below 1e-11
/// for |x| < 100; beyond, below 1e-16 x^2 (that of the phase in double).
std::complex<double> fresnel_integral(double x);

}  // namespace ensonify::array

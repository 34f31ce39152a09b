#pragma once

#include <complex>
#include <limits>

#include "kernels/acoustics/array/line.h"

/// Line arrays near their source: wave fronts are curved across the array, and a beam is focused at one range.
///
/// The distance from a point at range R and sine u to the element at x is R - x u + x^2 (1 - u^2) / (2 R) to second
/// order (Fresnel's approximation). The next term turns the phase at the array's ends by at most
/// 0.151 L^3 / (lambda R^2) rad: below pi / 8 beyond R = 0.62 sqrt(L^3 / lambda). Nearer, results are still finite but
/// only qualitative. Spreading across the array (1 / R differing between elements) is left out.
namespace ensonify::array {

/// C(x) + i S(x), the integral of exp(i pi v^2 / 2) dv over 0..x [Abramowitz1964, ch. 7.3]. Absolute error below 1e-11
/// for |x| < 100; beyond, below 1e-16 x^2 (that of the phase in double).
std::complex<double> fresnel_integral(double x);

inline constexpr double kFarAway_m = std::numeric_limits<double>::infinity();

/// Amplitude that a source at `range_m` and `sine` gives in a beam that is steered to `sin_steer` and focused at
/// `focus_m` (kFarAway_m: focusing off), over that of a source in the far field on the axis of the unsteered array.
/// With range_m = focus_m = kFarAway_m it is amplitude(). Both distances from the array's centre, above 0.
std::complex<double> near_field_amplitude(const LineArray& array, double wavelength_m, double sine, double sin_steer,
                                          double range_m, double focus_m = kFarAway_m);

/// The same of a continuous uniform line, unsteered, in closed form: with s = u L / lambda and
/// b = L^2 / lambda ((1 - u^2) / R - 1 / F) it is the integral of exp(i 2 pi (s t - b t^2 / 2)) dt over -1/2..1/2, by
/// Fresnel's integrals.
std::complex<double> near_field_line_amplitude(double length_m, double wavelength_m, double sine, double range_m,
                                               double focus_m = kFarAway_m);

/// L^2 / lambda, m: where a wave front from the axis is bent by lambda / 8 at the array's ends. There an unfocused
/// uniform line loses 0.24 dB on its axis against the far field; at half of it 0.97 dB, at a quarter 4.0 dB. Focused at
/// F, a beam is sharp where |1/R - 1/F| < lambda / L^2.
double near_field_range_m(const LineArray& array, double wavelength_m);

}  // namespace ensonify::array

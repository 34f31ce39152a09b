#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "kernels/acoustics/array/shading.h"

/// Line arrays of elements, far field, evaluated in the sine u of the angle from the plane across the line (u is the
/// direction cosine along the line), because a line array's beams are cones. near_field.h has the near field.
///
/// Amplitudes are complex with the phase of a signal that reaches the positive end of the line earlier than its centre
/// (the phase centre) advanced there. Everything is for one frequency: `wavelength_m` is sound speed at the face over
/// frequency, and the same array has a narrower beam at a higher one. Steering is by phase.
namespace ensonify::array {

struct LineArray {
  double spacing_m = 0.0;         // from element centre to element centre
  std::vector<double> weights;    // one per element, from the negative end to the positive one; may be negative
  double element_length_m = 0.0;  // of each element along the line, uniform; 0: a point

  int elements() const { return static_cast<int>(weights.size()); }
  double length_m() const { return spacing_m * elements(); }
};

/// Pattern in direction `sine` of the array steered to `sin_steer`:
///
///   sinc(l u / lambda) sum_n w_n exp(2 pi i x_n (u - u0) / lambda) / sum_n w_n.
///
/// Exact, with all side lobes and grating lobes. 1 on the axis of an unsteered array; an element of length l takes the
/// axis of a steered one down to sinc(l u0 / lambda). Precondition: the weights' sum is not zero.
std::complex<double> amplitude(const LineArray& array, double wavelength_m, double sine, double sin_steer = 0.0);

/// Squared magnitude of amplitude().
double power(const LineArray& array, double wavelength_m, double sine, double sin_steer = 0.0);

/// Sines at which the power falls to half of that at `sin_steer`, first on either side; -1 or 1 where it does not.
struct BeamEdges {
  double lower_sine = -1.0;
  double upper_sine = 1.0;
};
BeamEdges half_power_edges(const LineArray& array, double wavelength_m, double sin_steer = 0.0);

/// The same of any power pattern that does not fall to a half and rise again within `step` of sine.
BeamEdges half_power_edges(const std::function<double(double sine)>& pattern, double axis_sine, double step);

/// Angle between these edges, rad.
double half_power_width_rad(const LineArray& array, double wavelength_m, double sin_steer = 0.0);

/// Sine of the first null beside the axis of the unsteered array, 1 where there is none. Precondition: symmetric
/// weights, of which the pattern is real and passes through its nulls: a uniform line's is lambda / L.
double first_null(const LineArray& array, double wavelength_m);

/// Equivalent width in sine: the integral of power() over -1..1, so with grating lobes. Relative error below 1e-5.
double equivalent_width(const LineArray& array, double wavelength_m, double sin_steer = 0.0);

/// The same of the product of a transmit and a receive pattern along the same line. A uniform line twice: 2/3 of the
/// one-way width.
double two_way_equivalent_width(const LineArray& transmit, const LineArray& receive, double wavelength_m,
                                double sin_steer = 0.0);

/// Length of the uniform line whose beam covers as much: lambda over the equivalent width of an array of elements that
/// touch each other, (sum w)^2 / sum w^2 times the spacing (Parseval). A beam that reaches beyond -1..1 has less
/// equivalent width: 0.2 % for a uniform line 50 wavelengths long, 2 % for one of Dolph and Chebyshev.
double effective_length_m(const LineArray& array);

/// Sines at which the array factor is as high as on its axis, other than `sin_steer`: u0 + m lambda / spacing, inside
/// -1..1, ascending. None when the spacing is below lambda / (1 + |u0|).
std::vector<double> grating_lobes(const LineArray& array, double wavelength_m, double sin_steer = 0.0);

/// The array whose unsteered half-power width at `wavelength_m` is exactly `width_rad`, of elements that touch each
/// other (no gaps), spaced by at most about `spacing_in_waves`; above ten, an even number, which halves. For
/// instruments that state a beamwidth and no element. Throws std::invalid_argument unless 0 < width_rad <= pi/2 and 0 <
/// spacing_in_waves <= 1.
LineArray line_array_of_width(double width_rad, double wavelength_m, const Shading& shading = {},
                              double spacing_in_waves = 0.5);

/// Two parts of one array, for phase between them. Each has one weight per element of the whole array, 0 where it has
/// no part; a beam of a part is amplitude() with these weights.
struct SplitAperture {
  std::vector<double> negative;
  std::vector<double> positive;
  double baseline_m = 0.0;  // between the parts' phase centres, the centres of gravity of their weights
};

/// The first and the last `fraction` of the elements (rounded down; 0.5: halves, which leave an odd middle element
/// out; more: they overlap). The phase of the positive part over the negative one is 2 pi baseline (u - u0) / lambda:
/// for all u when the parts are uniform, to third order in u - u0 otherwise. Throws std::invalid_argument unless each
/// part has at least one and fewer than all elements.
SplitAperture split_aperture(const LineArray& array, double fraction = 0.5);

}  // namespace ensonify::array

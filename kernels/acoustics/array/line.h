#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "kernels/acoustics/array/shading.h"

/// Patterns of lines in the far field: continuous uniform ones in closed form, and arrays of weighted elements. They
/// are functions of the sine u of the angle from the plane across the line (the direction cosine along it), because a
/// line's beams are cones; all angles here are that angle. near_field.h has the near field.
///
/// Amplitudes of arrays are complex with the phase of a signal that reaches the positive end of the line earlier than
/// its centre (the phase centre) advanced there. Everything is for one frequency: `wavelength_m` is sound speed at the
/// face over frequency, and the same array has a narrower beam at a higher one. Steering is by phase.
namespace ensonify::array {

/// sin(pi x) / (pi x).
double sinc(double x);

/// Amplitude pattern, with sign, of a uniform line `length_in_waves` = L / lambda long, steered to `sin_steer`; 1 on
/// its axis. First sidelobes -13.26, -17.83, -20.79 dB [Lurton2010, ch. 5].
double line_amplitude(double length_in_waves, double sin_angle, double sin_steer = 0.0);

/// Power pattern, the square of line_amplitude.
double line_power(double length_in_waves, double sin_angle, double sin_steer = 0.0);

/// Integral of line_power over sine: lambda / L. (Over angle it is that divided by cos(steer).)
double equivalent_width(double length_in_waves);

/// Half-power half width in sine: 0.44295 lambda / L.
double half_power_half_width(double length_in_waves);

/// Full half-power width of the steered beam in angle, rad; exact. Infinite-cone edges beyond 90 deg are cut there.
double half_power_width_rad(double length_in_waves, double steer_rad = 0.0);

/// The length L / lambda whose unsteered half-power width is `width_rad`. Precondition: 0 < width_rad < pi.
double length_in_waves_for(double width_rad);

/// Directivity index of a plane rectangular aperture of both lengths, dB: 10 log10(4 pi Lx Ly / lambda^2) [Lurton2010].
double directivity_index_db(double length_in_waves, double width_in_waves);

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

/// Length of the uniform line whose beam covers as much: lambda over the equivalent width of an array of elements that
/// touch each other, (sum w)^2 / sum w^2 times the spacing (Parseval). A beam that reaches beyond -1..1 has less
/// equivalent width: 0.2 % for a uniform line 50 wavelengths long, 2 % for one of Dolph and Chebyshev.
double effective_length_m(const LineArray& array);

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

/// A pattern over sine -1..1 in equal steps with cubic interpolation, for one look-up per ray.
///
/// The pattern of an aperture that reaches at most r wavelengths from its phase centre has a fourth derivative of at
/// most (2 pi r)^4 times its largest amplitude (Bernstein), so a cubic through four points a step h apart is off by at
/// most 3/128 (2 pi r h)^4. The step follows from the error asked for: 12 points per lambda / L at -80 dB.
class PatternTable {
 public:
  /// pattern(sine) must be defined a few steps beyond -1..1 too. `error` is absolute: 1e-4 is -80 dB of a pattern that
  /// is 1 at its highest. Float rounding adds up to 1e-6. Throws std::invalid_argument unless error is 1e-6..0.1.
  PatternTable(const std::function<std::complex<double>(double sine)>& pattern, double reach_in_waves,
               double error = 1e-4);

  /// amplitude() of a steered array.
  PatternTable(const LineArray& array, double wavelength_m, double sin_steer = 0.0, double error = 1e-4);

  /// Complex amplitude; sines outside -1..1 count as -1 or 1.
  std::complex<float> amplitude(double sine) const { return amplitude(scale().interval(sine)); }

  /// Squared magnitude.
  float power(double sine) const {
    const std::complex<float> a = amplitude(sine);
    return a.real() * a.real() + a.imag() * a.imag();
  }

  std::size_t size() const { return points_.size(); }

  /// Between which points a sine lies, and their weights: amplitude() in parts, for vector code.
  struct Interval {
    std::int32_t step;
    float before, at, after, beyond;
  };
  struct Scale {
    double steps_per_sine;
    std::int32_t steps;

    Interval interval(double sine) const {
      const double position = (std::clamp(sine, -1.0, 1.0) + 1.0) * steps_per_sine;
      const std::int32_t step = std::min(static_cast<std::int32_t>(position), steps - 1);
      const auto t = static_cast<float>(position - step);
      const float before = t + 1.0F, after = t - 1.0F, beyond = t - 2.0F;
      return {step, t * after * beyond * (-1.0F / 6.0F), before * after * beyond * 0.5F, before * t * beyond * -0.5F,
              before * t * after * (1.0F / 6.0F)};
    }
  };
  Scale scale() const { return {steps_per_sine_, steps_}; }
  std::complex<float> amplitude(const Interval& in) const {
    const std::complex<float>* p = points_.data() + in.step;
    return {in.before * p[0].real() + in.at * p[1].real() + in.after * p[2].real() + in.beyond * p[3].real(),
            in.before * p[0].imag() + in.at * p[1].imag() + in.after * p[2].imag() + in.beyond * p[3].imag()};
  }

 private:
  int steps_ = 0;
  double steps_per_sine_ = 0.0;
  std::vector<std::complex<float>> points_;  // one before -1 and one beyond 1
};

/// That of a uniform line (line_amplitude), or of a face along one of its sides.
std::shared_ptr<const PatternTable> uniform_line_table(double length_in_waves, double error);

}  // namespace ensonify::array

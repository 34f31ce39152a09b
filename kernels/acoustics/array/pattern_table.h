#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>
#include <functional>
#include <vector>

#include "kernels/acoustics/array/line_array.h"

namespace ensonify::array {

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
  std::complex<float> amplitude(double sine) const {
    const double position = (std::clamp(sine, -1.0, 1.0) + 1.0) * steps_per_sine_;
    const int step = std::min(static_cast<int>(position), steps_ - 1);
    const auto t = static_cast<float>(position - step);
    const std::complex<float>* p = points_.data() + step;  // at -1, 0, 1, 2 steps from `step`
    const float before = t + 1.0F, after = t - 1.0F, beyond = t - 2.0F;
    const float w0 = t * after * beyond * (-1.0F / 6.0F), w1 = before * after * beyond * 0.5F;
    const float w2 = before * t * beyond * -0.5F, w3 = before * t * after * (1.0F / 6.0F);
    return {w0 * p[0].real() + w1 * p[1].real() + w2 * p[2].real() + w3 * p[3].real(),
            w0 * p[0].imag() + w1 * p[1].imag() + w2 * p[2].imag() + w3 * p[3].imag()};
  }

  /// Squared magnitude.
  float power(double sine) const {
    const std::complex<float> a = amplitude(sine);
    return a.real() * a.real() + a.imag() * a.imag();
  }

  std::size_t size() const { return points_.size(); }

 private:
  int steps_ = 0;
  double steps_per_sine_ = 0.0;
  std::vector<std::complex<float>> points_;  // one before -1 and one beyond 1
};

}  // namespace ensonify::array

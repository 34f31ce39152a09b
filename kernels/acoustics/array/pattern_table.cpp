#include "kernels/acoustics/array/pattern_table.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace ensonify::array {

PatternTable::PatternTable(const std::function<std::complex<double>(double sine)>& pattern, double reach_in_waves,
                           double error) {
  if (!(error >= 1e-6 && error <= 0.1)) {
    throw std::invalid_argument("a pattern table with an error of " + std::to_string(error) + ": allowed 1e-6 to 0.1");
  }
  const double step = std::pow(error * 128.0 / 3.0, 0.25) / (2.0 * std::numbers::pi * reach_in_waves);
  steps_ = static_cast<int>(std::ceil(2.0 / std::min(step, 0.5)));
  steps_per_sine_ = 0.5 * steps_;
  for (int i = -1; i < steps_ + 2; ++i) points_.emplace_back(pattern(i / steps_per_sine_ - 1.0));
}

PatternTable::PatternTable(const LineArray& array, double wavelength_m, double sin_steer, double error)
    : PatternTable([&](double u) { return array::amplitude(array, wavelength_m, u, sin_steer); },
                   0.5 * ((array.elements() - 1) * array.spacing_m + array.element_length_m) / wavelength_m, error) {}

}  // namespace ensonify::array

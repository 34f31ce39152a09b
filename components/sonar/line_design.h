#pragma once

#include <memory>

#include "components/config/parameters.h"
#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/array/shading.h"

namespace ensonify {

/// A line of a head as it is built: as long as its shading asks for to have a half-power width at a wavelength.
/// Designed once; with a wavelength of 1 its lengths are in wavelengths.
struct LineDesign {
  /// pattern_error: of its table (array::PatternTable).
  LineDesign(double half_power_rad, double at_wavelength_m, const array::Shading& shading, double pattern_error);

  double wavelength_m;
  array::LineArray line;
  double uniform_in_waves;    // length of the uniform line of the same width ...
  double effective_in_waves;  // ... and of the one that would see the same area
  double first_null;          // sine
  std::shared_ptr<const array::PatternTable> pattern;
};

/// Shading of a head's line, within what array::shading_weights takes.
template <>
struct ParametersOf<array::Shading> {
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    using Window = array::Shading::Window;
    visit("window", "",
          one_of({{"uniform", Window::kUniform},
                  {"hann", Window::kHann},
                  {"hamming", Window::kHamming},
                  {"dolph_chebyshev", Window::kDolphChebyshev},
                  {"taylor", Window::kTaylor}}),
          "weights along the line", self.window);
    visit("side_lobe_db", "dB", in(13, 100), "side lobes of dolph_chebyshev and taylor: one-way, below the main lobe",
          self.side_lobe_db);
    visit("nbar", "", in(1, 100), "number of side lobes that are level with taylor; the next ones fall", self.nbar);
  }
  static void check(const ConfigReader& from, const array::Shading& shading);
};

}  // namespace ensonify

#pragma once

#include "kernels/acoustics/array/line_array.h"
#include "kernels/acoustics/array/pattern_table.h"

namespace ensonify {

/// A line of a head as it is built: as long as its shading asks for to have a half-power width at a wavelength.
/// Designed once; with a wavelength of 1 its lengths are in wavelengths.
struct LineDesign {
  LineDesign(double half_power_rad, double at_wavelength_m, const array::Shading& shading);

  double wavelength_m;
  array::LineArray line;
  double uniform_in_waves;    // length of the uniform line of the same width ...
  double effective_in_waves;  // ... and of the one that would see the same area
  double first_null;          // sine
  array::PatternTable pattern;
};

}  // namespace ensonify

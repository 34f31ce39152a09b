#include "components/sonar/line_design.h"

#include <string>

#include "components/config/config_reader.h"
#include "kernels/acoustics/array/line.h"

namespace ensonify {

LineDesign::LineDesign(double half_power_rad, double at_wavelength_m, const array::Shading& shading,
                       double pattern_error)
    : wavelength_m(at_wavelength_m),
      line(array::line_array_of_width(half_power_rad, at_wavelength_m, shading)),
      uniform_in_waves(array::length_in_waves_for(half_power_rad)),
      effective_in_waves(array::effective_length_m(line) / at_wavelength_m),
      first_null(array::first_null(line, at_wavelength_m)),
      pattern(std::make_shared<array::PatternTable>(line, at_wavelength_m, 0.0, pattern_error)) {}

void ParametersOf<array::Shading>::check(const ConfigReader& from, const array::Shading& shading) {
  const int least = array::least_nbar(shading.side_lobe_db);
  if (shading.window == array::Shading::Window::kTaylor && shading.nbar < least) {
    from.problem("nbar", std::to_string(shading.nbar) +
                             " does not hold side lobes at side_lobe_db: " + std::to_string(least) + " to 100 do");
  }
}

}  // namespace ensonify

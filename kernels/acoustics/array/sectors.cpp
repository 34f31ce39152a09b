#include "kernels/acoustics/array/sectors.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "kernels/acoustics/array/line.h"

namespace ensonify::array {

std::optional<std::size_t> sector_of(std::span<const TransmitSector> sectors, double across_rad) {
  std::optional<std::size_t> nearest;
  double least = 1.0 + 1e-12;  // half widths; a direction on an edge is inside, rounded or not
  for (std::size_t i = 0; i < sectors.size(); ++i) {
    const double off = std::abs(across_rad - sectors[i].centre_rad) / (0.5 * sectors[i].width_rad);
    if (off < least) {
      nearest = i;
      least = off - 1e-12;
    }
  }
  return nearest;
}

SectorBeam sector_beam(double wavelength_m, double lower_sine, double upper_sine, double roll_off_sine) {
  const double width = upper_sine - lower_sine;
  if (!(roll_off_sine >= 0.01 && roll_off_sine <= width)) {
    throw std::invalid_argument("a sector " + std::to_string(width) + " wide in sine with a roll-off of " +
                                std::to_string(roll_off_sine) + ": allowed 0.01 to its width");
  }
  constexpr double kHammingTransition = 3.5;  // in lambda / L, from -0.04 to -50 dB
  constexpr double kSpacing_waves = 0.5;
  const int elements = static_cast<int>(std::ceil(kHammingTransition / (roll_off_sine * kSpacing_waves))) + 1;
  SectorBeam beam{.array = {.spacing_m = kSpacing_waves * wavelength_m,
                            .weights = shading_weights({.window = Shading::Window::kHamming}, elements)},
                  .sin_steer = 0.5 * (lower_sine + upper_sine)};
  for (int n = 0; n < elements; ++n) {
    const double x_waves = kSpacing_waves * (n - 0.5 * (elements - 1));
    beam.array.weights[static_cast<std::size_t>(n)] *= sinc(width * x_waves);
  }
  return beam;
}

}  // namespace ensonify::array

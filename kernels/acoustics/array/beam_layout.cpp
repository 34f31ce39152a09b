#include "kernels/acoustics/array/beam_layout.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "kernels/acoustics/array/line.h"

namespace ensonify::array {
namespace {

void check(double lower_rad, double upper_rad, int count) {
  constexpr double kLimit_rad = std::numbers::pi / 2.0;
  if (!(-kLimit_rad < lower_rad && lower_rad < upper_rad && upper_rad < kLimit_rad)) {
    throw std::invalid_argument("a swath from " + std::to_string(lower_rad) + " to " + std::to_string(upper_rad) +
                                " rad: allowed inside -pi/2 to pi/2, ascending");
  }
  if (count < 2) throw std::invalid_argument(std::to_string(count) + " beams: at least 2");
}

}  // namespace

std::vector<float> equiangular_beams_rad(double lower_rad, double upper_rad, int count) {
  check(lower_rad, upper_rad, count);
  std::vector<float> beams;
  for (int i = 0; i < count; ++i)
    beams.push_back(static_cast<float>(std::lerp(lower_rad, upper_rad, i / (count - 1.0))));
  return beams;
}

std::vector<float> equidistant_beams_rad(double lower_rad, double upper_rad, int count) {
  check(lower_rad, upper_rad, count);
  const double lower = std::tan(lower_rad), upper = std::tan(upper_rad);
  std::vector<float> beams;
  for (int i = 0; i < count; ++i) {
    beams.push_back(static_cast<float>(std::atan(std::lerp(lower, upper, i / (count - 1.0)))));
  }
  return beams;
}

HighDensity high_density_beams(double lower_rad, double upper_rad, int beams, int soundings) {
  if (soundings < beams) {
    throw std::invalid_argument(std::to_string(soundings) + " soundings of " + std::to_string(beams) +
                                " beams: at least one per beam");
  }
  HighDensity layout{.beam_rad = equiangular_beams_rad(lower_rad, upper_rad, beams),
                     .sounding_rad = equidistant_beams_rad(lower_rad, upper_rad, soundings)};
  const auto off_axis = [&](int beam, float sounding_rad) {
    return std::abs(std::sin(layout.beam_rad[static_cast<std::size_t>(beam)]) - std::sin(sounding_rad));
  };
  int nearest = 0;
  for (const float sounding_rad : layout.sounding_rad) {
    while (nearest + 1 < beams && off_axis(nearest + 1, sounding_rad) < off_axis(nearest, sounding_rad)) ++nearest;
    layout.beam_of_sounding.push_back(nearest);
  }
  return layout;
}

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

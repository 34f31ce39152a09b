#include "kernels/survey/grid/band.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "kernels/seabed/statistics/power_spectrum.h"

namespace ensonify::survey_grid {
namespace {

constexpr int kWindow = 64;
constexpr double kSteepest = 4.1;  // between what seabeds and what grids do

/// Weighted sums along one line of values, `step` apart; the weights are those of a Gaussian, from its middle outwards.
void smear(const std::vector<double>& weight, const std::vector<double>& from, std::vector<double>& to,
           std::size_t first, std::size_t step, int count) {
  const int reach = static_cast<int>(weight.size()) - 1;
  for (int i = 0; i < count; ++i) {
    double sum = 0.0;
    for (int k = std::max(-reach, -i); k <= std::min(reach, count - 1 - i); ++k)
      sum += weight[static_cast<std::size_t>(std::abs(k))] * from[first + static_cast<std::size_t>(i + k) * step];
    to[first + static_cast<std::size_t>(i) * step] = sum;
  }
}

/// Weighted sums over both directions.
void smear(const Surface& surface, const std::vector<double>& weight, std::vector<double>& values) {
  const auto columns = static_cast<std::size_t>(surface.columns);
  std::vector<double> along(values.size());
  tbb::parallel_for(0, surface.rows, [&](int row) {
    smear(weight, values, along, static_cast<std::size_t>(row) * columns, 1, surface.columns);
  });
  tbb::parallel_for(0, surface.columns, [&](int column) {
    smear(weight, along, values, static_cast<std::size_t>(column), columns, surface.rows);
  });
}

}  // namespace

Band band_of(const Surface& surface) {
  relief_statistics::check(surface);
  Band band;
  const auto spectrum = relief_statistics::radial_spectrum(surface, kWindow);
  if (spectrum.density_m4.empty() ||
      std::all_of(spectrum.density_m4.begin(), spectrum.density_m4.end(), [](double w) { return !(w > 0.0); }))
    return band;
  const double wave_number_radpm = 2.0 * std::numbers::pi / surface.spacing_m;  // of a wave of one cell
  for (double cells = 2.0; cells < 0.5 * kWindow; cells *= 2.0) {
    const auto law =
        relief_statistics::fit_power_law(spectrum, wave_number_radpm / (2.0 * cells), wave_number_radpm / cells);
    band.octaves.push_back({cells, 2.0 * cells, law.exponent});
  }
  for (const Octave& octave : band.octaves) {
    if (octave.exponent < kSteepest) break;
    band.begins_cells = octave.to_cells;
  }
  return band;
}

void remove_shorter_waves(Surface& surface, double cells) {
  relief_statistics::check(surface);
  if (!(cells >= 2.0)) throw std::invalid_argument("waves shorter than 2 cells are not on a grid; allowed: 2 or more");
  // exp(-(2 pi sigma / L)^2) of the power passes at wave length L: one half at L = cells.
  const double sigma = cells * std::sqrt(std::numbers::ln2) / (2.0 * std::numbers::pi);
  std::vector<double> weight;
  for (int k = 0; k <= static_cast<int>(std::ceil(4.0 * sigma)); ++k)
    weight.push_back(std::exp(-0.5 * k * k / (sigma * sigma)));
  std::vector<double> height(surface.height_m.size()), known(height.size());
  for (std::size_t i = 0; i < height.size(); ++i) {
    known[i] = std::isnan(surface.height_m[i]) ? 0.0 : 1.0;
    height[i] = known[i] > 0.0 ? static_cast<double>(surface.height_m[i]) : 0.0;
  }
  smear(surface, weight, height);
  smear(surface, weight, known);
  for (std::size_t i = 0; i < height.size(); ++i) {
    if (!std::isnan(surface.height_m[i])) surface.height_m[i] = static_cast<float>(height[i] / known[i]);
  }
}

}  // namespace ensonify::survey_grid

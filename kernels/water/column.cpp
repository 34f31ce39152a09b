#include "kernels/water/column.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace ensonify::water {

Column::Column(std::vector<SeaWater> samples) : samples_(std::move(samples)) {
  if (samples_.empty()) throw std::invalid_argument("a water column needs at least one sample");
  for (std::size_t i = 1; i < samples_.size(); ++i) {
    if (!(samples_[i].depth_m > samples_[i - 1].depth_m)) {
      throw std::invalid_argument("sample " + std::to_string(i) + " of the water column lies at " +
                                  std::to_string(samples_[i].depth_m) + " m, not below the one before it at " +
                                  std::to_string(samples_[i - 1].depth_m) + " m; depths must rise");
    }
  }
}

SeaWater Column::at(double depth_m) const {
  const auto below = std::upper_bound(samples_.begin(), samples_.end(), depth_m,
                                      [](double depth, const SeaWater& sample) { return depth < sample.depth_m; });
  const SeaWater& lower = below == samples_.end() ? samples_.back() : *below;
  const SeaWater& upper = below == samples_.begin() ? samples_.front() : *(below - 1);
  const double span_m = lower.depth_m - upper.depth_m;
  const double w = span_m > 0.0 ? (depth_m - upper.depth_m) / span_m : 0.0;
  return {std::lerp(upper.temperature_degc, lower.temperature_degc, w),
          std::lerp(upper.salinity_psu, lower.salinity_psu, w), depth_m, std::lerp(upper.ph, lower.ph, w)};
}

double Column::mean_absorption_dbpm(AbsorptionLaw law, double frequency_hz, double from_depth_m,
                                    double to_depth_m) const {
  const auto [top_m, bottom_m] = std::minmax(from_depth_m, to_depth_m);
  if (top_m == bottom_m) return absorption_dbpm(law, frequency_hz, at(top_m));

  std::vector<double> edges{top_m};
  for (const SeaWater& sample : samples_) {
    if (sample.depth_m > top_m && sample.depth_m < bottom_m) edges.push_back(sample.depth_m);
  }
  edges.push_back(bottom_m);

  // Gauss-Legendre with three nodes between samples, where temperature and salinity are straight lines.
  constexpr double kNode = 0.7745966692414834;  // sqrt(3/5)
  double sum = 0.0;
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const double middle_m = 0.5 * (edges[i - 1] + edges[i]);
    const double half_m = 0.5 * (edges[i] - edges[i - 1]);
    const auto there = [&](double node) { return absorption_dbpm(law, frequency_hz, at(middle_m + node * half_m)); };
    sum += half_m * (5.0 * there(-kNode) + 8.0 * there(0.0) + 5.0 * there(kNode)) / 9.0;
  }
  return sum / (bottom_m - top_m);
}

double volume_scattering_db(std::span<const ScatteringLayer> layers, double depth_m) {
  double sv = 0.0;
  for (const ScatteringLayer& layer : layers) {
    if (depth_m >= layer.top_depth_m && depth_m < layer.bottom_depth_m) sv += std::pow(10.0, layer.sv_db / 10.0);
  }
  return 10.0 * std::log10(sv);
}

}  // namespace ensonify::water

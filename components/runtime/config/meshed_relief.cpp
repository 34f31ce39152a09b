#include "components/runtime/config/meshed_relief.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ensonify {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSteepest_deg = 35.0;
constexpr double kFar_m = 1000.0;  // outer scale: at posts it takes less than 1 % from D

/// The sediment's relief as a surface.
relief::Spectrum spectrum_of(const seabed::SedimentParameters& sediment) {
  const double gamma = sediment.spectral_exponent, hurst = 0.5 * gamma - 1.0;
  const double strength_si = sediment.spectral_strength_cm4 * std::pow(10.0, 2.0 * gamma - 8.0);
  return {.rms_m = relief::rms_of_strength_m(strength_si, hurst, kFar_m), .hurst = hurst, .outer_scale_m = kFar_m};
}

/// The relief of a layer, if it shows on this class and is as rough everywhere.
const relief::Spectrum* even_relief(const layers::Layer& layer, std::uint8_t seabed_class) {
  const auto* spectral = std::get_if<layers::Spectral>(&layer.form);
  if (spectral == nullptr || !layer.used) return nullptr;
  if (spectral->intermittency != 0.0 || spectral->height_gain != 0.0 || spectral->rough) return nullptr;
  const bool everywhere = layer.join == relief::Layer::Join::kAdd && !layer.mask && !layer.sediment;
  return everywhere || layer.sediment == seabed_class ? &spectral->spectrum : nullptr;
}

}  // namespace

double facet_slope_deg(const Seabed& seabed, std::uint8_t seabed_class, const seabed::SedimentParameters& sediment) {
  double mean_square = 0.0;
  for (const layers::Layer& layer : seabed.layered.layers) {
    if (const auto* spectrum = even_relief(layer, seabed_class))
      mean_square += relief::facet_mean_square_slope(*spectrum, seabed.post_spacing_m);
  }
  const double own = relief::facet_mean_square_slope(spectrum_of(sediment), seabed.post_spacing_m);
  const double slope_deg = std::atan(std::sqrt(std::min(mean_square, own))) / kDegree;
  return std::min(std::round(1e4 * slope_deg) / 1e4, kSteepest_deg);
}

seabed::MeshedSediment on_facets(const std::variant<seabed::SedimentParameters, seabed::CappedSediment>& whole,
                                 double facet_slope_deg) {
  const double slope = std::tan(facet_slope_deg * kDegree);
  return {whole, slope * slope};
}

double facet_slope_deg(const seabed::MeshedSediment& meshed) {
  return std::atan(std::sqrt(meshed.mean_square_slope)) / kDegree;
}

void count_meshed_relief(Seabed& seabed) {
  if (seabed.kind != Seabed::Kind::kLayers) return;
  for (auto& [number, scatterer] : seabed.sediments) {
    if (const auto* plain = std::get_if<seabed::SedimentParameters>(&scatterer)) {
      const double slope_deg = facet_slope_deg(seabed, number, *plain);
      if (slope_deg > 0.0) scatterer = on_facets(*plain, slope_deg);
    } else if (const auto* capped = std::get_if<seabed::CappedSediment>(&scatterer)) {
      const double slope_deg = facet_slope_deg(seabed, number, capped->sediment);
      if (slope_deg > 0.0) scatterer = on_facets(*capped, slope_deg);
    }
  }
}

}  // namespace ensonify

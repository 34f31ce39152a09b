#include "components/runtime/config/meshed_relief.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "kernels/relief/intermittency.h"

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

/// Mean of a polygon's mask over the seabed's rectangle, by 64 x 64 places.
double share_of_polygon(const layers::Mask& mask, const LayeredSeabed& seabed) {
  constexpr int kPlaces = 64;  // per side
  std::vector<float> inside(static_cast<std::size_t>(kPlaces) * kPlaces);
  const double step_m = seabed.size_m.maxCoeff() / kPlaces;
  const frames::Vec2 corner = (seabed.centre_enu_m - 0.5 * seabed.size_m) / step_m;
  const relief::Window window{0, std::llround(corner.x()), std::llround(corner.y()),
                              std::max(1, static_cast<int>(std::lround(seabed.size_m.x() / step_m))),
                              std::max(1, static_cast<int>(std::lround(seabed.size_m.y() / step_m)))};
  const auto places = std::span(inside).first(window.size());
  relief::in_polygon(mask.polygon_enu_m, mask.polygon_softness_m, step_m)(window, places);
  return std::accumulate(places.begin(), places.end(), 0.0) / static_cast<double>(places.size());
}

/// Share of the places of a class where a mask holds, its terms taken as independent of each other and of the class.
/// Nothing where that is up to the seabed's shape: depth, slope, curvature.
std::optional<double> share_of(const layers::Mask& mask, std::uint8_t seabed_class, const LayeredSeabed& seabed) {
  double share = 1.0;
  const bool of_shape = mask.depth_m || mask.slope || mask.curvature_1pm;
  if (!mask.sediments.empty() && std::ranges::find(mask.sediments, seabed_class) == mask.sediments.end()) share = 0.0;
  if (!mask.polygon_enu_m.empty()) share *= share_of_polygon(mask, seabed);
  if (mask.patches) share *= mask.patches->share;
  if (!mask.any.empty()) {
    double none = 1.0;
    for (const layers::Mask& one : mask.any) {
      const auto part = share_of(one, seabed_class, seabed);
      if (!part) return std::nullopt;
      none *= 1.0 - *part;
    }
    share *= 1.0 - none;
  }
  if (of_shape && share > 0.0) return std::nullopt;
  return mask.reverse ? 1.0 - share : share;
}

bool holds_at_most_places(const std::optional<layers::Mask>& mask, std::uint8_t seabed_class,
                          const LayeredSeabed& seabed) {
  return !mask || share_of(*mask, seabed_class, seabed).value_or(0.0) >= 0.5;
}

/// Whether a layer is part of the seabed at a typical place of the class.
bool shows_on(const layers::Layer& layer, std::uint8_t seabed_class, const LayeredSeabed& seabed) {
  if (!layer.used) return false;
  if (layer.sediment) return layer.sediment == seabed_class;
  return layer.join == relief::Layer::Join::kAdd && holds_at_most_places(layer.mask, seabed_class, seabed);
}

/// Mean square slope of its facets at a typical place: half of all places have less.
double typical_mean_square(const layers::Spectral& spectral, std::uint8_t seabed_class, const Seabed& seabed) {
  const double d = seabed.post_spacing_m;
  double ln_variance = 0.0, amplitude = 1.0;  // of the amplitude where each octave is made
  if (spectral.intermittency > 0.0)
    ln_variance +=
        relief::LognormalCascade({spectral.intermittency, spectral.spectrum.outer_scale_m}, d, 0, "").ln_variance();
  if (spectral.height_gain != 0.0)
    ln_variance += relief::HeightGain({spectral.spectrum, d, 0, ""}, spectral.height_gain).ln_variance();
  if (!holds_at_most_places(spectral.rough, seabed_class, seabed.layered)) amplitude = spectral.smooth_amplitude;
  return amplitude * amplitude * std::exp(-2.0 * ln_variance) * relief::facet_mean_square_slope(spectral.spectrum, d);
}

}  // namespace

double facet_slope_deg(const Seabed& seabed, std::uint8_t seabed_class, const seabed::SedimentParameters& sediment) {
  double mean_square = 0.0;
  for (const layers::Layer& layer : seabed.layered.layers) {
    const auto* spectral = std::get_if<layers::Spectral>(&layer.form);
    if (spectral != nullptr && shows_on(layer, seabed_class, seabed.layered))
      mean_square += typical_mean_square(*spectral, seabed_class, seabed);
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

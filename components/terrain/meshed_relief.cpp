#include "components/terrain/meshed_relief.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <utility>
#include <variant>

#include "components/terrain/layered_seabed.h"
#include "kernels/seabed/law.h"
#include "kernels/seabed/relief/spectral_surface.h"
#include "scenarios/world/seabed.h"

namespace ensonify::source {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSteepest_deg = 35.0;
constexpr double kFar_m = 1000.0;           // outer scale: at posts it takes less than 1 % from D
constexpr double kSome = 0.1, kMost = 0.9;  // of a class's places
constexpr double kWorthReporting_db = 0.1;

/// The sediment's relief as a surface.
relief::Spectrum spectrum_of(const seabed::SedimentParameters& sediment) {
  const double gamma = sediment.spectral_exponent, hurst = 0.5 * gamma - 1.0;
  const double strength_si = sediment.spectral_strength_cm4 * std::pow(10.0, 2.0 * gamma - 8.0);
  return {.rms_m = relief::rms_of_strength_m(strength_si, hurst, kFar_m), .hurst = hurst, .outer_scale_m = kFar_m};
}

/// Mean square slope of a layer's facets at a typical place where masks leave all of it: half of these have less.
double typical_mean_square(const layers::Spectral& spectral, double post_spacing_m) {
  double ln_variance = 0.0;  // of the amplitude where each octave is made
  if (spectral.intermittency > 0.0) {
    const relief::CascadeParameters cascade{spectral.intermittency, spectral.spectrum.outer_scale_m};
    ln_variance += relief::LognormalCascade(cascade, post_spacing_m, 0, "").ln_variance();
  }
  if (spectral.height_gain != 0.0) {
    const relief::SpectralSurface surface(spectral.spectrum, post_spacing_m, 0, "");
    ln_variance += relief::HeightGain(surface, spectral.height_gain).ln_variance();
  }
  return std::exp(-2.0 * ln_variance) * relief::facet_mean_square_slope(spectral.spectrum, post_spacing_m);
}

/// A layer whose relief is of the kind that laws of sediments count.
struct Relief {
  std::string layer;
  std::optional<std::uint8_t> gives_class;  // nothing: it adds to all classes
  bool masked = false;                      // one that gives its class has the mask where the class is
  bool has_rough = false;
  double smooth_amplitude = 1.0;
  double mean_square = 0.0;  // of slopes, typical_mean_square()
};

std::vector<Relief> reliefs_of(const Seabed& seabed) {
  std::vector<Relief> reliefs;
  for (const layers::Layer& layer : seabed.layered.layers) {
    const auto* spectral = std::get_if<layers::Spectral>(&layer.form);
    if (spectral == nullptr || !layer.used) continue;
    if (!layer.sediment && layer.join != relief::Layer::Join::kAdd) continue;
    reliefs.push_back({layer.name, layer.sediment, layer.mask && !layer.sediment, spectral->rough.has_value(),
                       spectral->smooth_amplitude, typical_mean_square(*spectral, seabed.post_spacing_m)});
  }
  return reliefs;
}

/// One place stands for all of them where no mask distinguishes them.
SeabedPlaces places_for(const std::vector<Relief>& reliefs, const Seabed& seabed, const LayeredFields& fields) {
  std::set<std::string> masked;
  for (const Relief& relief : reliefs) {
    if (relief.masked || relief.has_rough) masked.insert(relief.layer);
  }
  if (masked.empty()) return {.count = 1, .seabed_class = {}, .mask = {}, .rough = {}};
  return places_of(seabed.layered, seabed.post_spacing_m, fields, masked);
}

/// Of values at places, that which half of the places exceed.
double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The slopes of a class's facets, place by place.
class SlopesOfClass {
 public:
  /// A place of a class that is not among the sediments counts as class 0; all places do for a class that none has.
  SlopesOfClass(const Seabed& seabed, const std::vector<Relief>& reliefs, const SeabedPlaces& places,
                std::uint8_t seabed_class, const seabed::SedimentParameters& sediment)
      : places_(places), own_(relief::facet_mean_square_slope(spectrum_of(sediment), seabed.post_spacing_m)) {
    for (const Relief& relief : reliefs) {
      if (relief.gives_class.value_or(seabed_class) == seabed_class) reliefs_.push_back(relief);
    }
    for (std::size_t i = 0; i < places.seabed_class.size(); ++i) {
      const std::uint8_t here = places.seabed_class[i];
      if ((seabed.sediments.contains(here) ? here : 0) == seabed_class) where_.push_back(i);
    }
    if (where_.empty()) {
      where_.resize(places.count);
      std::iota(where_.begin(), where_.end(), std::size_t{0});
    }
  }

  /// Mean square at a typical place, by relief that the sediment's law counts too.
  double typical() const { return typical_of(where_); }

  /// What UnevenClass indicates a layer, but for what it makes of echoes.
  struct Part {
    std::string layer;
    double share = 0.0;
    double lesser = 0.0;  // mean square at the lesser part's typical place
  };
  std::vector<Part> parts() const {
    std::vector<Part> parts;
    for (const Relief& relief : reliefs_) {
      std::vector<std::size_t> with, without;
      for (const std::size_t place : where_) (holds(relief, place) ? with : without).push_back(place);
      const double share = static_cast<double>(with.size()) / static_cast<double>(where_.size());
      if (share >= kSome && share <= kMost)
        parts.push_back({relief.layer, share, typical_of(share < 0.5 ? with : without)});
    }
    return parts;
  }

 private:
  double mask_at(const Relief& relief, std::size_t place) const {
    return relief.masked ? static_cast<double>(places_.mask.at(relief.layer)[place]) : 1.0;
  }
  double rough_at(const Relief& relief, std::size_t place) const {
    return relief.has_rough ? static_cast<double>(places_.rough.at(relief.layer)[place]) : 1.0;
  }
  bool holds(const Relief& relief, std::size_t place) const {
    return mask_at(relief, place) * rough_at(relief, place) >= 0.5;
  }
  double amplitude(const Relief& relief, std::size_t place) const {
    return mask_at(relief, place) * std::lerp(relief.smooth_amplitude, 1.0, rough_at(relief, place));
  }
  double typical_of(const std::vector<std::size_t>& where) const {
    std::vector<double> mean_square;
    for (const std::size_t place : where) {
      double sum = 0.0;
      for (const Relief& relief : reliefs_) sum += std::pow(amplitude(relief, place), 2) * relief.mean_square;
      mean_square.push_back(std::min(sum, own_));
    }
    return median(std::move(mean_square));
  }

  const SeabedPlaces& places_;
  double own_;  // the sediment's own mean square slope between posts
  std::vector<Relief> reliefs_;
  std::vector<std::size_t> where_;  // places of the class
};

using Whole = std::variant<seabed::SedimentParameters, seabed::CappedSediment>;

std::optional<Whole> whole_of(const seabed::Scatterer& scatterer) {
  if (const auto* plain = std::get_if<seabed::SedimentParameters>(&scatterer)) return *plain;
  if (const auto* capped = std::get_if<seabed::CappedSediment>(&scatterer)) return *capped;
  return std::nullopt;
}

const seabed::SedimentParameters& sediment_of(const Whole& whole) {
  if (const auto* capped = std::get_if<seabed::CappedSediment>(&whole)) return capped->sediment;
  return std::get<seabed::SedimentParameters>(whole);
}

seabed::MeshedSediment on_facets_of(const Whole& whole, double mean_square) {
  const double slope_deg = std::atan(std::sqrt(mean_square)) / kDegree;
  return on_facets(whole, std::min(std::round(1e4 * slope_deg) / 1e4, kSteepest_deg));
}

/// How far echoes at right angles from facets of another slope are off those from facets that the law is made for.
double off_db(const seabed::MeshedSediment& meshed, double mean_square) {
  double worst_db = 0.0;
  for (const double frequency_hz : {100e3, 300e3}) {
    const seabed::Law law = seabed::law_of(meshed, frequency_hz, 1500.0);
    const auto mean = [&](double slope) { return seabed::mean_over_facets(law, slope, 0.5 * std::numbers::pi); };
    const double here_db = 10.0 * std::log10(mean(mean_square) / mean(meshed.mean_square_slope));
    if (std::abs(here_db) > std::abs(worst_db)) worst_db = here_db;
  }
  return worst_db;
}

}  // namespace

MeshedRelief meshed_relief(const Seabed& seabed, const LayeredFields& fields) {
  const auto reliefs = reliefs_of(seabed);
  const auto places = places_for(reliefs, seabed, fields);
  MeshedRelief found;
  for (const auto& [number, scatterer] : seabed.sediments) {
    const auto whole = whole_of(scatterer);
    if (!whole) continue;
    const SlopesOfClass slopes(seabed, reliefs, places, number, sediment_of(*whole));
    const auto meshed = on_facets_of(*whole, slopes.typical());
    if (meshed.mean_square_slope > 0.0) {
      found.mean_square_slope.resize(number + 1U);
      found.mean_square_slope[number] = meshed.mean_square_slope;
    }
    for (const auto& part : slopes.parts()) {
      const double db = off_db(meshed, part.lesser);
      if (std::abs(db) >= kWorthReporting_db) found.uneven.push_back({part.layer, number, part.share, db});
    }
  }
  return found;
}

std::string text_of(const UnevenClass& uneven) {
  return fmt::format(
      "layer {} holds at {:.2f} of class {}, which has one strength for both parts: where it {}, echoes at right "
      "angles "
      "are off by up to {:+.1f} dB; give {} part a sediment of its own",
      uneven.layer, uneven.share, uneven.seabed_class, uneven.share < 0.5 ? "holds" : "does not", uneven.off_db,
      uneven.share < 0.5 ? "that" : "the other");
}

}  // namespace ensonify::source

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "components/config/config_reader.h"
#include "kernels/seabed/law.h"
#include "scenarios/world/layer_terms.h"

namespace ensonify::terms {
namespace {

using Names = std::vector<std::string>;  // of the layers so far

double slope_of(double deg) { return std::tan(deg * kDegrees.si); }
double same(double x) { return x; }

/// `si` turns the unit of the file into what the mask compares.
template <class Band>
std::optional<relief::Band> band_of(const std::optional<Band>& file, double (*si)(double)) {
  if (!file) return std::nullopt;
  relief::Band band;
  if (file->low) band.low = si(*file->low);
  if (file->high) band.high = si(*file->high);
  band.softness = si(file->soft);
  return band;
}

/// A layer further up in the list.
void check_earlier(const ConfigReader& from, const std::string& key, const Names& earlier, const std::string& name) {
  if (name.empty() || std::find(earlier.begin(), earlier.end(), name) != earlier.end()) return;
  std::string known;
  for (const std::string& layer : earlier) known += (known.empty() ? "" : ", ") + layer;
  from.problem(key, "is \"" + name + "\", not a layer further up; allowed: " + (known.empty() ? "none" : known));
}

void check_mask(const ConfigReader& from, const std::string& key, const Names& earlier, const Mask& mask) {
  check_earlier(from, key + ".of", earlier, mask.of);
  for (std::size_t i = 0; i < mask.any.size(); ++i) {
    check_mask(from, key + ".any[" + std::to_string(i) + "]", earlier, mask.any[i]);
  }
}

void check_range(const ConfigReader& from, const char* key, const std::array<double, 2>& range) {
  if (range[1] < range[0]) from.problem(key, "is not [least, most]");
}

}  // namespace

template <int least, int most>
void Band<least, most>::check(const ConfigReader& from) const {
  if (!from.has("from") && !from.has("to")) from.problem("", "needs from or to");
  if (low.value_or(least) > high.value_or(most)) from.problem("to", "is below from");
}
template struct Band<-1000, 11000>;
template struct Band<0, 80>;
template struct Band<-100, 100>;

void Mask::check(const ConfigReader& from) const {
  if (from.has("polygon_m") && (!corners_m || corners_m->size() < 3)) {
    from.problem("polygon_m", "needs three corners or more");
  }
}

layers::Mask Mask::mask() const {
  layers::Mask mask;
  mask.of = of;
  mask.scale_m = scale_m;
  mask.depth_m = band_of(depth_m, same);
  mask.slope = band_of(slope_deg, slope_of);
  mask.curvature_1pm = band_of(curvature_1pm, same);
  if (corners_m) {
    for (const auto& corner : *corners_m) mask.polygon_enu_m.emplace_back(corner[0], corner[1]);
  }
  mask.polygon_softness_m = softness_m;
  mask.sediments = sediments;
  if (patches) mask.patches = *patches;
  for (const Mask& other : any) mask.any.push_back(other.mask());
  mask.reverse = reverse;
  return mask;
}

layers::Form Plane::form() const {
  auto plane = static_cast<const relief::Plane&>(*this);
  plane.slope = slope_of(slope_deg);
  return plane;
}

layers::Form Sphere::form() const {
  auto sphere = static_cast<const relief::Sphere&>(*this);
  sphere.centre_depth_m = centre_m.value_or(depth_m);
  return sphere;
}

void SedimentStrength::check(const ConfigReader& from) const {
  if (!sediment.empty() && !seabed::sediment_of(sediment)) {
    from.problem("as_sediment", "is \"" + sediment + "\", not a sediment of APL-UW TR 9407");
  }
}

void Spectral::check(const ConfigReader& from) const {
  if (from.has("rms_m") && from.has("as_sediment")) {
    from.problem("", "has rms_m and as_sediment; give one or the other");
  }
  if (from.has("smooth_amplitude") && !from.has("rough")) {
    from.problem("smooth_amplitude", "needs rough, the mask of rough places");
  }
}

/// rms_m, or the strength that the sediment's backscatter model has, carried on to long waves.
layers::Form Spectral::form() const {
  auto spectral = static_cast<const layers::Spectral&>(*this);
  if (rough_places) spectral.rough = rough_places->mask();
  relief::Spectrum& of = spectral.spectrum;
  if (const auto* rms = std::get_if<RmsStrength>(&strength)) {
    of.rms_m = rms->rms_m;
    return spectral;
  }
  const auto sediment = seabed::sediment_of(std::get<SedimentStrength>(strength).sediment);
  if (!sediment) return spectral;
  const double gamma = sediment->spectral_exponent;
  of.hurst = 0.5 * gamma - 1.0;
  const double strength_si = sediment->spectral_strength_cm4 * std::pow(10.0, 2.0 * gamma - 8.0);
  of.rms_m = relief::rms_of_strength_m(strength_si, of.hurst, of.outer_scale_m);
  return spectral;
}

layers::Form Ripples::form() const {
  auto ripples = static_cast<const relief::RippleParameters&>(*this);
  // Measured dunes: 0.5 to 0.8 of the mean.
  ripples.height_m = crest_m.value_or(0.65 * relief::flemming_height_m(wavelength_m));
  return ripples;
}

template <relief::BodyShape of>
void Bodies<of>::check(const ConfigReader& from) const {
  if (largest_radius_m < smallest_radius_m) from.problem("largest_radius_m", "is below smallest_radius_m");
}
template struct Bodies<relief::BodyShape::kBoulder>;
template struct Bodies<relief::BodyShape::kMound>;
template struct Bodies<relief::BodyShape::kPockmark>;

void Marks::check(const ConfigReader& from) const {
  check_range(from, "half_width_m", half_width_m);
  if (!(half_width_m[0] > 0.0)) from.problem("half_width_m", "must be above 0");
}

relief::MarkParameters Marks::si(const std::array<double, 2>& spacing_m) const {
  auto marks = static_cast<const relief::MarkParameters&>(*this);
  marks.least_spacing_m = spacing_m[0], marks.most_spacing_m = spacing_m[1];
  marks.least_half_width_m = half_width_m[0], marks.most_half_width_m = half_width_m[1];
  return marks;
}

void TrawlScars::check(const ConfigReader& from) const {
  Marks::check(from);
  check_range(from, "spacing_m", spacing_m);
}

void Dredged::check(const ConfigReader& from) const {
  if (from.has("line_m") && line_m.size() < 2) from.problem("line_m", "needs two places or more");
}

layers::Form Dredged::form() const {
  layers::Dredged dredged{.line_enu_m = {}, .half_width_m = half_width_m, .side_slope = slope_of(side_slope_deg)};
  for (const auto& p : line_m) dredged.line_enu_m.emplace_back(p[0], p[1], -p[2]);
  return dredged;
}

void Guide::check(const ConfigReader& from) const {
  if (from.has("raster") && from.has("tiles")) {
    from.problem("", "needs one of raster (a file that GDAL reads) and tiles (the folder of a tile set)");
  }
}

layers::Form Guide::form() const {
  layers::Guide guide;
  guide.cell_m = cell_m;
  if (const auto* tiles = std::get_if<GuideTiles>(&file)) guide.tiles_folder = tiles->tiles;
  if (const auto* raster = std::get_if<GuideRaster>(&file)) {
    guide.raster = raster->raster;
    guide.values_are_depths = raster->are_depths;
  }
  return guide;
}

Layer::Join Layer::joined() const {
  return join.value_or(std::holds_alternative<Is<Dredged>>(is) ? Join::kCut : Join::kAdd);
}

void Layer::check(const ConfigReader& from) const {
  if (from.has("above") && joined() == Join::kAdd)
    from.problem("above", "needs join: cover or cut; a layer that adds counts from the seabed under it");
  if (!std::holds_alternative<Paint>(is) || sediment) return;
  std::string known;
  for (const Form& form : FormsOf<Form>::all()) {
    std::visit(
        [&]<class Of>(const Of&) {
          if constexpr (requires { Of{}.term; })
            known += (known.empty() ? "" : ", ") + std::string(decltype(Of::term)::kKey);
        },
        form);
  }
  from.problem("", "is nothing: it needs a sediment to paint, or one of " + known);
}

layers::Layer Layer::layer() const {
  layers::Layer layer;
  layer.name = name;
  layer.used = use;
  layer.form = std::visit([](const auto& form) { return form.form(); }, is);
  layer.join = joined();
  layer.above = above;
  if (mask) layer.mask = mask->mask();
  layer.sediment = sediment;
  layer.shows_above_m = shows_above_m;
  return layer;
}

void check_names(const ConfigReader& from, const std::vector<Layer>& layers) {
  Names earlier;
  for (const Layer& layer : layers) {
    const std::string key = "layers." + layer.name;
    check_earlier(from, key + ".above", earlier, layer.above);
    if (layer.mask) check_mask(from, key + ".mask", earlier, *layer.mask);
    if (const auto* restored = std::get_if<Is<Restored>>(&layer.is)) {
      check_earlier(from, key + ".restored.guide", earlier, restored->term.guide);
    }
    if (const auto* spectral = std::get_if<Is<Spectral>>(&layer.is); spectral && spectral->term.rough_places) {
      check_mask(from, key + ".spectral.rough", earlier, *spectral->term.rough_places);
    }
    earlier.push_back(layer.name);
  }
}

}  // namespace ensonify::terms

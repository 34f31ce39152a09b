#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "kernels/seabed/law.h"
#include "scenarios/world/sections.h"

namespace ensonify {
namespace {

using frames::Vec2;
using Names = std::vector<std::string>;  // of the layers so far

Vec2 read_place(ConfigReader& from, const char* key, bool must = false) {
  std::array<double, 2> place{};
  if (must) from.required(key, place, -kFarAway_m, kFarAway_m);
  else from.optional(key, place, -kFarAway_m, kFarAway_m);
  return {place[0], place[1]};
}

/// A layer further up in the list.
void read_earlier(ConfigReader& from, const char* key, const Names& earlier, std::string& name) {
  from.optional(key, name);
  if (name.empty() || std::find(earlier.begin(), earlier.end(), name) != earlier.end()) return;
  std::string known;
  for (const std::string& layer : earlier) known += (known.empty() ? "" : ", ") + layer;
  from.problem(key, "is \"" + name + "\", not a layer further up; allowed: " + (known.empty() ? "none" : known));
}

// --- masks
// ------------------------------------------------------------------------------------------------------------

/// `{ from, to, soft }` in the unit of the file; `si` turns it into what the mask compares.
std::optional<relief::Band> read_band(const ConfigReader& mask, const char* key, double least, double most,
                                      const std::function<double(double)>& si) {
  auto from = mask.optional_section(key);
  if (!from) return std::nullopt;
  relief::Band band;
  double low = least, high = most, soft = 0.0;
  from->optional("from", low, least, most);
  from->optional("to", high, least, most);
  from->optional("soft", soft, 0, most - least);
  if (!from->has("from") && !from->has("to")) from->problem("", "needs from or to");
  if (low > high) from->problem("to", "is below from");
  if (from->has("from")) band.low = si(low);
  if (from->has("to")) band.high = si(high);
  band.softness = si(soft);
  return band;
}

layers::Mask read_mask(ConfigReader from, const Names& earlier) {
  layers::Mask mask;
  const auto same = [](double x) { return x; };
  const auto slope_of = [](double deg) { return std::tan(deg * kDegrees.si); };
  read_earlier(from, "of", earlier, mask.of);
  from.optional("scale_m", mask.scale_m, 1e-3, kFarAway_m);
  mask.depth_m = read_band(from, "depth_m", -1000, 11000, same);
  mask.slope = read_band(from, "slope_deg", 0, 80, slope_of);
  mask.curvature_1pm = read_band(from, "curvature_1pm", -100, 100, same);
  std::vector<std::array<double, 2>> polygon;
  from.optional("polygon_m", polygon, -kFarAway_m, kFarAway_m);
  for (const auto& corner : polygon) mask.polygon_enu_m.emplace_back(corner[0], corner[1]);
  if (from.has("polygon_m") && polygon.size() < 3) from.problem("polygon_m", "needs three corners or more");
  from.optional("soft_m", mask.polygon_softness_m, 0, kFarAway_m);
  mask.sediments = read_classes(from, "sediment");
  if (auto section = from.optional_section("patches")) {
    layers::Mask::Patches patches;
    section->required("length_m", patches.length_m, 1e-2, kFarAway_m);
    section->optional("share", patches.share, 0.001, 0.999);
    section->optional("soft", patches.softness, 0, 10);
    mask.patches = patches;
  }
  for (const ConfigReader& term : from.list("any")) mask.any.push_back(read_mask(term, earlier));
  from.optional("reverse", mask.reverse);
  return mask;
}

// --- what a layer is
// ----------------------------------------------------------------------------------------------------

layers::Form read_plane(ConfigReader from) {
  relief::Plane plane;
  double slope_deg = 0.0;
  from.optional("depth_m", plane.depth_m, -1000, 11000);
  from.optional("slope_deg", slope_deg, 0, 60);
  from.optional("downhill_heading_deg", plane.downhill_heading_rad, -360, 360, kDegrees);
  plane.slope = std::tan(slope_deg * kDegrees.si);
  return plane;
}

layers::Form read_ramp(ConfigReader from) {
  relief::Ramp ramp;
  ramp.middle_enu_m = read_place(from, "middle_m");
  from.optional("heading_deg", ramp.heading_rad, -360, 360, kDegrees);
  from.optional("depth_m", ramp.depth_m, -1000, 11000);
  from.optional("drop_m", ramp.drop_m, -1000, 1000);
  from.optional("run_m", ramp.run_m, 0, kFarAway_m);
  return ramp;
}

layers::Form read_wave(ConfigReader from) {
  relief::Wave wave;
  from.optional("depth_m", wave.depth_m, -1000, 11000);
  from.optional("amplitude_m", wave.amplitude_m, 0, 1000);
  from.required("wavelength_m", wave.wavelength_m, 1e-2, kFarAway_m);
  from.optional("heading_deg", wave.heading_rad, -360, 360, kDegrees);
  return wave;
}

layers::Form read_sphere(ConfigReader from) {
  relief::Sphere sphere;
  sphere.centre_enu_m = read_place(from, "centre_m");
  from.required("radius_m", sphere.radius_m, 1e-2, 10000);
  from.optional("depth_m", sphere.depth_m, -1000, 11000);
  sphere.centre_depth_m = sphere.depth_m;
  from.optional("centre_depth_m", sphere.centre_depth_m, -1000, 11000);
  return sphere;
}

layers::Form read_ridge(ConfigReader from) {
  relief::Ridge ridge;
  ridge.start_enu_m = read_place(from, "from_m", true);
  ridge.end_enu_m = read_place(from, "to_m", true);
  from.required("height_m", ridge.height_m, -1000, 1000);
  from.optional("width_m", ridge.width_m, 0.1, kFarAway_m);
  return ridge;
}

/// rms_m, or the strength that the sediment's backscatter model has, carried on to long waves.
void read_strength(ConfigReader& from, relief::Spectrum& spectrum) {
  if (from.has("rms_m") == from.has("as_sediment")) {
    from.problem("", from.has("rms_m") ? "has rms_m and as_sediment; give one or the other"
                                       : "needs rms_m, or as_sediment (a sediment whose roughness goes on)");
  }
  from.optional("rms_m", spectrum.rms_m, 0, 10000);
  std::string name;
  from.optional("as_sediment", name);
  if (name.empty()) return;
  const auto sediment = seabed::sediment_of(name);
  if (!sediment) return from.problem("as_sediment", "is \"" + name + "\", not a sediment of APL-UW TR 9407");
  const double gamma = sediment->spectral_exponent;
  spectrum.hurst = 0.5 * gamma - 1.0;
  const double strength_si = sediment->spectral_strength_cm4 * std::pow(10.0, 2.0 * gamma - 8.0);
  spectrum.rms_m = relief::rms_of_strength_m(strength_si, spectrum.hurst, spectrum.outer_scale_m);
}

layers::Form read_spectral(ConfigReader from, const Names& earlier) {
  layers::Spectral spectral;
  from.required("outer_scale_m", spectral.spectrum.outer_scale_m, 1e-3, 1e6);
  from.optional("inner_scale_m", spectral.spectrum.inner_scale_m, 0, 1e6);
  from.optional("hurst", spectral.spectrum.hurst, 0.01, 1);
  from.optional("mean_m", spectral.mean_m, -1000, 1000);
  read_strength(from, spectral.spectrum);
  from.optional("intermittency", spectral.intermittency, 0, 0.7);
  from.optional("height_gain", spectral.height_gain, -1, 1);
  from.optional("smooth_amplitude", spectral.smooth_amplitude, 0, 1);
  if (const auto rough = from.optional_section("rough")) spectral.rough = read_mask(*rough, earlier);
  else if (from.has("smooth_amplitude")) from.problem("smooth_amplitude", "needs rough, the mask of rough places");
  return spectral;
}

layers::Form read_ripples(ConfigReader from) {
  relief::RippleParameters ripples;
  from.required("wavelength_m", ripples.wavelength_m, 1e-2, 10000);
  ripples.height_m = 0.65 * relief::flemming_height_m(ripples.wavelength_m);  // measured dunes: 0.5 to 0.8
  from.optional("height_m", ripples.height_m, 0, 100);
  from.optional("travel_heading_deg", ripples.travel_heading_rad, -360, 360, kDegrees);
  from.optional("lee_fraction", ripples.lee_fraction, 0.3, 0.5);
  from.optional("disorder", ripples.disorder, 0, 1);
  from.optional("patch_wavelengths", ripples.patch_wavelengths, 0.1, 1000);
  from.optional("height_ln_sd", ripples.height_ln_sd, 0, 1);
  return ripples;
}

layers::Form read_bodies(ConfigReader from, relief::BodyShape shape) {
  relief::BodyParameters bodies;
  bodies.shape = shape;
  if (shape != relief::BodyShape::kBoulder) bodies.height_per_radius = 0.2;
  from.required("per_km2", bodies.per_km2, 0, 1e8);
  from.required("smallest_radius_m", bodies.smallest_radius_m, 1e-3, 1000);
  from.required("largest_radius_m", bodies.largest_radius_m, 1e-3, 1000);
  from.optional("size_exponent", bodies.size_exponent, 0.01, 20);
  from.optional("height_per_radius", bodies.height_per_radius, 0, 10);
  from.optional("height_ln_sd", bodies.height_ln_sd, 0, 2);
  from.optional("elongation", bodies.elongation, 1, 4);
  if (bodies.largest_radius_m < bodies.smallest_radius_m)
    from.problem("largest_radius_m", "is below smallest_radius_m");
  return bodies;
}

void read_range(ConfigReader& from, const char* key, double& least, double& most) {
  std::array<double, 2> range{least, most};
  from.optional(key, range, 0, 10000);
  if (range[1] < range[0]) from.problem(key, "is not [least, most]");
  least = range[0];
  most = range[1];
}

layers::Form read_marks(ConfigReader from, bool pairs) {
  relief::MarkParameters marks;
  from.required("per_km2", marks.tracks_per_km2, 0, 1e5);
  from.optional("length_m", marks.length_m, 0.1, 50000);
  from.optional("heading_deg", marks.heading_rad, -360, 360, kDegrees);
  from.optional("heading_sd_deg", marks.heading_sd_rad, 0, 180, kDegrees);
  from.optional("curvature_sd_1pm", marks.curvature_sd_1pm, 0, 1);
  if (pairs) read_range(from, "spacing_m", marks.least_spacing_m, marks.most_spacing_m);
  else marks.least_spacing_m = marks.most_spacing_m = 0.0;
  read_range(from, "half_width_m", marks.least_half_width_m, marks.most_half_width_m);
  if (!(marks.least_half_width_m > 0.0)) from.problem("half_width_m", "must be above 0");
  from.optional("depth_m", marks.depth_m, 0, 100);
  from.optional("faded", marks.faded, 0, 1);
  from.optional("spoil", marks.spoil, 0, 1);
  return marks;
}

layers::Form read_dredged(ConfigReader from) {
  layers::Dredged dredged;
  std::vector<std::array<double, 3>> line;
  from.required("line_m", line, -kFarAway_m, kFarAway_m);
  for (const auto& p : line) dredged.line_enu_m.emplace_back(p[0], p[1], -p[2]);
  if (from.has("line_m") && line.size() < 2) from.problem("line_m", "needs two places or more");
  from.required("half_width_m", dredged.half_width_m, 1e-2, kFarAway_m);
  double side_deg = 11.3;  // 1:5
  from.optional("side_slope_deg", side_deg, 0.1, 80);
  dredged.side_slope = std::tan(side_deg * kDegrees.si);
  return dredged;
}

layers::Form read_guide(ConfigReader from) {
  layers::Guide guide;
  if (from.has("raster") == from.has("tiles"))
    from.problem("", "needs one of raster (a file that GDAL reads) and tiles (the folder of a tile set)");
  from.optional_path("raster", guide.raster);
  from.optional_path("tiles", guide.tiles_folder);
  if (from.has("raster"))
    from.required_choice("values", guide.values_are_depths, {{"elevation", false}, {"depth", true}});
  from.required("cell_m", guide.cell_m, 1e-2, 1000);
  return guide;
}

layers::Form read_restored(ConfigReader from, const Names& earlier) {
  layers::Restored restored;
  from.required("guide", restored.guide);
  read_earlier(from, "guide", earlier, restored.guide);
  from.optional("hurst", restored.hurst, 0.01, 1);
  from.optional("band_start_cells", restored.band_start_cells, 2, 16);
  return restored;
}

/// What a layer can be, by its key.
struct Term {
  const char* key;
  std::function<layers::Form(const ConfigReader&, const Names&)> read;
  relief::Layer::Join join = relief::Layer::Join::kAdd;
};

const std::vector<Term>& terms() {
  const auto alone = [](layers::Form (*read)(ConfigReader)) {
    return [read](const ConfigReader& from, const Names&) { return read(from); };
  };
  const auto bodies = [](relief::BodyShape shape) {
    return [shape](const ConfigReader& from, const Names&) { return read_bodies(from, shape); };
  };
  const auto marks = [](bool pairs) {
    return [pairs](const ConfigReader& from, const Names&) { return read_marks(from, pairs); };
  };
  static const std::vector<Term> all = {{"plane", alone(read_plane)},
                                        {"ramp", alone(read_ramp)},
                                        {"wave", alone(read_wave)},
                                        {"sphere", alone(read_sphere)},
                                        {"guide", alone(read_guide)},
                                        {"restored", read_restored},
                                        {"ridge", alone(read_ridge)},
                                        {"spectral", read_spectral},
                                        {"ripples", alone(read_ripples)},
                                        {"boulders", bodies(relief::BodyShape::kBoulder)},
                                        {"mounds", bodies(relief::BodyShape::kMound)},
                                        {"pockmarks", bodies(relief::BodyShape::kPockmark)},
                                        {"trawl_scars", marks(true)},
                                        {"anchor_drags", marks(false)},
                                        {"dredged", alone(read_dredged), relief::Layer::Join::kCut}};
  return all;
}

layers::Layer read_layer(const std::string& name, ConfigReader& from, const Names& earlier) {
  layers::Layer layer;
  layer.name = name;
  std::string found, known;
  for (const Term& term : terms()) {
    known += (known.empty() ? "" : ", ") + std::string(term.key);
    if (!from.has(term.key)) continue;
    if (!found.empty()) from.problem(term.key, "stands beside " + found + "; a layer is one thing, make two of it");
    found = term.key;
    layer.join = term.join;
    layer.form = term.read(from.section(term.key), earlier);
  }
  from.optional("use", layer.used);
  from.optional_choice(
      "join", layer.join,
      {{"add", relief::Layer::Join::kAdd}, {"cover", relief::Layer::Join::kCover}, {"cut", relief::Layer::Join::kCut}});
  read_earlier(from, "above", earlier, layer.above);
  if (from.has("above") && layer.join == relief::Layer::Join::kAdd)
    from.problem("above", "needs join: cover or cut; a layer that adds counts from the seabed under it");
  if (const auto mask = from.optional_section("mask")) layer.mask = read_mask(*mask, earlier);
  from.optional("sediment", layer.sediment, 0, 255);
  from.optional("shows_above_m", layer.shows_above_m, 0, 1000);
  if (found.empty() && !layer.sediment)
    from.problem("", "is nothing: it needs a sediment to paint, or one of " + known);
  return layer;
}

}  // namespace

std::vector<std::uint8_t> read_classes(ConfigReader& from, const char* key) {
  std::vector<double> numbers;
  std::vector<std::uint8_t> classes;
  from.optional(key, numbers, 0, 255);
  for (const double number : numbers) {
    if (number != std::floor(number)) from.problem(key, "holds a number that is not a class, a whole number");
    else classes.push_back(static_cast<std::uint8_t>(number));
  }
  return classes;
}

std::vector<layers::Layer> read_layers(const ConfigReader& seabed) {
  std::vector<layers::Layer> layers;
  Names names;
  for (auto& [name, from] : seabed.named_sections("layers")) {
    layers.push_back(read_layer(name, from, names));
    names.push_back(name);
  }
  return layers;
}

}  // namespace ensonify

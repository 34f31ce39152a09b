#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "components/config/read_parameters.h"
#include "kernels/seabed/law.h"
#include "scenarios/world/layer_terms.h"
#include "scenarios/world/sections.h"

namespace ensonify {
namespace {

using frames::Vec2;
using Names = std::vector<std::string>;  // of the layers so far

/// Reads one of the terms.
template <class Term>
Term read_term(ConfigReader& from) {
  Term term;
  read_parameters(from, term);
  return term;
}

/// A layer further up in the list.
void check_earlier(const ConfigReader& from, const char* key, const Names& earlier, const std::string& name) {
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
  terms::Band file(least, most);
  read_parameters(*from, file);
  const auto& [low, high, soft, lo, hi] = file;
  if (!from->has("from") && !from->has("to")) from->problem("", "needs from or to");
  if (low > high) from->problem("to", "is below from");
  if (from->has("from")) band.low = si(low);
  if (from->has("to")) band.high = si(high);
  band.softness = si(soft);
  return band;
}

layers::Mask read_mask(ConfigReader from, const Names& earlier) {
  terms::Mask mask;
  read_parameters(from, mask);
  const auto same = [](double x) { return x; };
  const auto slope_of = [](double deg) { return std::tan(deg * kDegrees.si); };
  check_earlier(from, "of", earlier, mask.of);
  mask.depth_m = read_band(from, "depth_m", -1000, 11000, same);
  mask.slope = read_band(from, "slope_deg", 0, 80, slope_of);
  mask.curvature_1pm = read_band(from, "curvature_1pm", -100, 100, same);
  for (const auto& corner : mask.corners_m) mask.polygon_enu_m.emplace_back(corner[0], corner[1]);
  if (from.has("polygon_m") && mask.corners_m.size() < 3) from.problem("polygon_m", "needs three corners or more");
  mask.sediments = read_classes(from, "sediment");
  if (auto section = from.optional_section("patches")) {
    mask.patches = read_term<terms::Patches>(*section);
  }
  for (const ConfigReader& term : from.list("any")) mask.any.push_back(read_mask(term, earlier));
  const layers::Mask& read = mask;  // without what only the file has
  return read;
}

// --- what a layer is
// ----------------------------------------------------------------------------------------------------

layers::Form read_plane(ConfigReader from) {
  auto plane = read_term<terms::Plane>(from);
  plane.slope = std::tan(plane.slope_deg * kDegrees.si);
  return static_cast<relief::Plane&>(plane);
}

template <class Term, class Form>
layers::Form read_plain(ConfigReader from) {
  return static_cast<Form>(read_term<Term>(from));
}

layers::Form read_sphere(ConfigReader from) {
  auto sphere = read_term<terms::Sphere>(from);
  sphere.centre_depth_m = sphere.centre_m.value_or(sphere.depth_m);
  return static_cast<relief::Sphere&>(sphere);
}

/// rms_m, or the strength that the sediment's backscatter model has, carried on to long waves.
void read_strength(ConfigReader& from, relief::Spectrum& spectrum) {
  if (from.has("rms_m") == from.has("as_sediment")) {
    from.problem("", from.has("rms_m") ? "has rms_m and as_sediment; give one or the other"
                                       : "needs rms_m, or as_sediment (a sediment whose roughness goes on)");
  }
  const auto strength = read_term<terms::Strength>(from);
  const std::string& name = strength.as_sediment;
  if (from.has("rms_m")) spectrum.rms_m = strength.rms_m;
  if (name.empty()) return;
  const auto sediment = seabed::sediment_of(name);
  if (!sediment) return from.problem("as_sediment", "is \"" + name + "\", not a sediment of APL-UW TR 9407");
  const double gamma = sediment->spectral_exponent;
  spectrum.hurst = 0.5 * gamma - 1.0;
  const double strength_si = sediment->spectral_strength_cm4 * std::pow(10.0, 2.0 * gamma - 8.0);
  spectrum.rms_m = relief::rms_of_strength_m(strength_si, spectrum.hurst, spectrum.outer_scale_m);
}

layers::Form read_spectral(ConfigReader from, const Names& earlier) {
  auto spectral = read_term<terms::Spectral>(from);
  read_strength(from, spectral.spectrum);
  if (const auto rough = from.optional_section("rough")) spectral.rough = read_mask(*rough, earlier);
  else if (from.has("smooth_amplitude")) from.problem("smooth_amplitude", "needs rough, the mask of rough places");
  return static_cast<layers::Spectral&>(spectral);
}

layers::Form read_ripples(ConfigReader from) {
  auto ripples = read_term<terms::Ripples>(from);
  // Measured dunes: 0.5 to 0.8 of the mean.
  ripples.height_m = ripples.crest_m.value_or(0.65 * relief::flemming_height_m(ripples.wavelength_m));
  return static_cast<relief::RippleParameters&>(ripples);
}

layers::Form read_bodies(ConfigReader from, relief::BodyShape shape) {
  terms::Bodies bodies;
  bodies.shape = shape;
  if (shape != relief::BodyShape::kBoulder) bodies.height_per_radius = 0.2;
  read_parameters(from, bodies);
  if (bodies.largest_radius_m < bodies.smallest_radius_m)
    from.problem("largest_radius_m", "is below smallest_radius_m");
  return static_cast<relief::BodyParameters&>(bodies);
}

void set_range(const ConfigReader& from, const char* key, const std::array<double, 2>& range, double& least,
               double& most) {
  if (range[1] < range[0]) from.problem(key, "is not [least, most]");
  least = range[0];
  most = range[1];
}

layers::Form read_marks(ConfigReader from, bool pairs) {
  auto marks = read_term<terms::Marks>(from);
  marks.least_spacing_m = marks.most_spacing_m = 0.0;
  if (pairs) {
    set_range(from, "spacing_m", read_term<terms::Spacing>(from).spacing_m, marks.least_spacing_m,
              marks.most_spacing_m);
  }
  set_range(from, "half_width_m", marks.half_width_m, marks.least_half_width_m, marks.most_half_width_m);
  if (!(marks.least_half_width_m > 0.0)) from.problem("half_width_m", "must be above 0");
  return static_cast<relief::MarkParameters&>(marks);
}

layers::Form read_dredged(ConfigReader from) {
  const auto file = read_term<terms::Dredged>(from);
  layers::Dredged dredged{.half_width_m = file.half_width_m, .side_slope = std::tan(file.side_slope_deg * kDegrees.si)};
  for (const auto& p : file.line_m) dredged.line_enu_m.emplace_back(p[0], p[1], -p[2]);
  if (from.has("line_m") && file.line_m.size() < 2) from.problem("line_m", "needs two places or more");
  return dredged;
}

layers::Form read_guide(ConfigReader from) {
  auto guide = read_term<terms::GuideFiles>(from);
  if (from.has("raster") == from.has("tiles"))
    from.problem("", "needs one of raster (a file that GDAL reads) and tiles (the folder of a tile set)");
  if (from.has("raster")) guide.values_are_depths = read_term<terms::GuideValues>(from).are_depths;
  return static_cast<layers::Guide&>(guide);
}

layers::Form read_restored(ConfigReader from, const Names& earlier) {
  const auto restored = read_term<terms::Restored>(from);
  check_earlier(from, "guide", earlier, restored.guide);
  return static_cast<const layers::Restored&>(restored);
}

/// What a layer can be, by its key.
struct Term {
  const char* key;
  std::function<layers::Form(const ConfigReader&, const Names&)> read;
  relief::Layer::Join join = relief::Layer::Join::kAdd;
};

const std::vector<Term>& all_terms() {
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
                                        {"ramp", alone(read_plain<terms::Ramp, relief::Ramp>)},
                                        {"wave", alone(read_plain<terms::Wave, relief::Wave>)},
                                        {"sphere", alone(read_sphere)},
                                        {"guide", alone(read_guide)},
                                        {"restored", read_restored},
                                        {"ridge", alone(read_plain<terms::Ridge, relief::Ridge>)},
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
  terms::Common layer;
  layer.name = name;
  std::string found, known;
  for (const Term& term : all_terms()) {
    known += (known.empty() ? "" : ", ") + std::string(term.key);
    if (!from.has(term.key)) continue;
    if (!found.empty()) from.problem(term.key, "stands beside " + found + "; a layer is one thing, make two of it");
    found = term.key;
    layer.join = term.join;
    layer.form = term.read(from.section(term.key), earlier);
  }
  read_parameters(from, layer);
  check_earlier(from, "above", earlier, layer.above);
  if (from.has("above") && layer.join == relief::Layer::Join::kAdd)
    from.problem("above", "needs join: cover or cut; a layer that adds counts from the seabed under it");
  if (const auto mask = from.optional_section("mask")) layer.mask = read_mask(*mask, earlier);
  if (found.empty() && !layer.sediment)
    from.problem("", "is nothing: it needs a sediment to paint, or one of " + known);
  return layer;
}

ParameterList mask_list(int depth) {
  ParameterList list = parameters_of<terms::Mask>();
  list.push_back(section_info("depth_m", "between these depths in m", parameters_of(terms::Band(-1000, 11000))));
  list.push_back(section_info("slope_deg", "between these slopes in degrees", parameters_of(terms::Band(0, 80))));
  list.push_back(
      section_info("curvature_1pm", "between these curvatures in 1/m", parameters_of(terms::Band(-100, 100))));
  list.push_back(classes_info("sediment", "classes that the layers before this one gave"));
  list.push_back(
      section_info("patches", "irregular patches that cover a share of everything", parameters_of<terms::Patches>()));
  if (depth > 0) list.push_back(list_info("any", "at least one of these masks holds", mask_list(depth - 1)));
  return list;
}

}  // namespace

ParameterList layer_list() {
  constexpr int kNested = 2;  // masks of masks that the schema knows
  const ParameterList mask = mask_list(kNested);
  const auto joined = [](ParameterList list, const ParameterList& more) {
    list.insert(list.end(), more.begin(), more.end());
    return list;
  };
  const auto optional_values = [] {
    ParameterInfo values = parameters_of<terms::GuideValues>().front();
    values.allowed.required = false;  // only of a raster
    return values;
  };
  ParameterList spectral = joined(parameters_of<terms::Spectral>(), parameters_of<terms::Strength>());
  spectral.push_back(section_info("rough", "mask of rough places, octave by octave", mask));
  const ParameterList bodies = parameters_of<terms::Bodies>(), marks = parameters_of<terms::Marks>();
  ParameterList list = parameters_of<terms::Common>();
  list.push_back(section_info("mask", "where it applies; heights are multiplied by it", mask));
  list.push_back(section_info("plane", "a plane", parameters_of<terms::Plane>()));
  list.push_back(section_info("ramp", "a ramp or a step", parameters_of<terms::Ramp>()));
  list.push_back(section_info("wave", "a cosine", parameters_of<terms::Wave>()));
  list.push_back(section_info("sphere", "a sphere in a level bottom", parameters_of<terms::Sphere>()));
  list.push_back(section_info("guide", "a macro shape from a file",
                              joined(parameters_of<terms::GuideFiles>(), {optional_values()})));
  list.push_back(
      section_info("restored", "detail that a guide of coarse cells lacks", parameters_of<terms::Restored>()));
  list.push_back(section_info("ridge", "a ridge or a trough", parameters_of<terms::Ridge>()));
  list.push_back(section_info("spectral", "relief of a spectrum, plain or multifractal", spectral));
  list.push_back(section_info("ripples", "ripples or dunes", parameters_of<terms::Ripples>()));
  list.push_back(section_info("boulders", "boulders", bodies));
  list.push_back(section_info("mounds", "mounds", bodies));
  list.push_back(section_info("pockmarks", "pockmarks", bodies));
  list.push_back(section_info("trawl_scars", "pairs of furrows", joined(marks, parameters_of<terms::Spacing>())));
  list.push_back(section_info("anchor_drags", "single furrows", marks));
  list.push_back(section_info("dredged", "a channel, cut into the seabed", parameters_of<terms::Dredged>()));
  return list;
}

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

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "components/config/parameters.h"
#include "scenarios/world/layers.h"
#include "scenarios/world/mission.h"

/// The layers of a generated seabed as a file has them: terms that a layer can be, masks, and what all layers have. A
/// term has its key and what the key holds; form() is it in SI.
namespace ensonify {
class ConfigReader;
}
namespace ensonify::terms {

inline constexpr double kHighest_m = 1000.0, kDeepest_m = 11000.0;
inline Allowed depth() { return in(-kHighest_m, kDeepest_m); }
inline Allowed heading() { return in(-360, 360); }
inline Allowed place() { return in(-kFarAway_m, kFarAway_m); }

// --- masks ---------------------------------------------------------------------------------------------------------

/// A band in the unit of the file.
template <int least, int most>
struct Band {
  std::optional<double> low, high;
  double soft = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("from", "", in(least, most), "lower limit", self.low);
    visit("to", "", in(least, most), "upper limit", self.high);
    visit("soft", "", in(0, most - least), "falls off over this beyond the limits", self.soft);
  }
  void check(const ConfigReader& from) const;
};

struct Patches : layers::Mask::Patches {
  static void parameters(auto& self, auto&& visit) {
    visit("length_m", "m", must(in(1e-2, kFarAway_m)), "typical size of a patch", self.length_m);
    visit("share", "", in(0.001, 0.999), "share of everything that patches cover", self.share);
    visit("soft", "", in(0, 10), "width of their border, in standard deviations of the noise that draws it",
          self.softness);
  }
};

struct Mask {
  std::string of;
  double scale_m = layers::Mask{}.scale_m;
  std::optional<std::vector<std::array<double, 2>>> corners_m;
  double softness_m = 0.0;
  bool reverse = false;
  std::optional<Band<-1000, 11000>> depth_m;
  std::optional<Band<0, 80>> slope_deg;
  std::optional<Band<-100, 100>> curvature_1pm;
  std::vector<std::uint8_t> sediments;
  std::optional<Patches> patches;
  std::vector<Mask> any;

  static void parameters(auto& self, auto&& visit) {
    visit("of", "", computed(ensonify::any()), "layer up to which the seabed counts for depth, slope, curvature",
          self.of);
    visit("scale_m", "m", in(1e-3, kFarAway_m), "scale at which depth, slope, curvature and sediment are taken",
          self.scale_m);
    visit("polygon_m", "m", place(), "corners: [[east, north], ...]", self.corners_m);
    visit("soft_m", "m", in(0, kFarAway_m), "width of the polygon's border", self.softness_m);
    visit("reverse", "", ensonify::any(), "complement: true where all the rest does not hold", self.reverse);
    visit("depth_m", "depths in m between which it holds", self.depth_m);
    visit("slope_deg", "slopes in degrees between which it holds", self.slope_deg);
    visit("curvature_1pm", "curvatures in 1/m between which it holds", self.curvature_1pm);
    visit("sediment", "", computed(called("a class", in(0, 255))), "classes that the layers before this one gave",
          self.sediments);
    visit("patches", "irregular patches that cover a share of everything", self.patches);
    visit("any", "masks of which at least one must hold", self.any);
  }
  void check(const ConfigReader& from) const;
  layers::Mask mask() const;
};

// --- what a layer is -----------------------------------------------------------------------------------------------

struct Plane : relief::Plane {
  static constexpr const char *kKey = "plane", *kAbout = "a plane";
  double slope_deg = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("depth_m", "m", depth(), "depth at the origin", self.depth_m);
    visit("slope_deg", "", in(0, 60), "steepest slope, degrees", self.slope_deg);
    visit("downhill_heading_deg", "deg", heading(), "heading to which the plane falls", self.downhill_heading_rad);
  }
  layers::Form form() const;
};

struct Ramp : relief::Ramp {
  static constexpr const char *kKey = "ramp", *kAbout = "a ramp or a step";
  static void parameters(auto& self, auto&& visit) {
    visit("middle_m", "m", place(), "east, north of its middle", self.middle_enu_m);
    visit("heading_deg", "deg", heading(), "heading to which the ramp falls", self.heading_rad);
    visit("depth_m", "m", depth(), "depth before it", self.depth_m);
    visit("drop_m", "m", in(-1000, 1000), "drop of the seabed behind the ramp", self.drop_m);
    visit("run_m", "m", in(0, kFarAway_m), "length of the ramp; 0: a step", self.run_m);
  }
  layers::Form form() const { return static_cast<const relief::Ramp&>(*this); }
};

struct Wave : relief::Wave {
  static constexpr const char *kKey = "wave", *kAbout = "a cosine";
  static void parameters(auto& self, auto&& visit) {
    visit("depth_m", "m", depth(), "mean depth", self.depth_m);
    visit("amplitude_m", "m", in(0, 1000), "amplitude of a cosine with a crest at the origin", self.amplitude_m);
    visit("wavelength_m", "m", must(in(1e-2, kFarAway_m)), "distance from crest to crest", self.wavelength_m);
    visit("heading_deg", "deg", heading(), "across the crests", self.heading_rad);
  }
  layers::Form form() const { return static_cast<const relief::Wave&>(*this); }
};

struct Sphere : relief::Sphere {
  static constexpr const char *kKey = "sphere", *kAbout = "a sphere in a level bottom";
  std::optional<double> centre_m;

  static void parameters(auto& self, auto&& visit) {
    visit("centre_m", "m", place(), "east, north of its centre", self.centre_enu_m);
    visit("radius_m", "m", must(in(1e-2, 10000)), "radius of the sphere", self.radius_m);
    visit("depth_m", "m", depth(), "depth of the level bottom", self.depth_m);
    visit("centre_depth_m", "m", depth(), "depth of its centre; left out: that of the bottom", self.centre_m);
  }
  layers::Form form() const;
};

struct Ridge : relief::Ridge {
  static constexpr const char *kKey = "ridge", *kAbout = "a ridge or a trough";
  static void parameters(auto& self, auto&& visit) {
    visit("from_m", "m", must(place()), "east, north of its start", self.start_enu_m);
    visit("to_m", "m", must(place()), "east, north of its end", self.end_enu_m);
    visit("height_m", "m", must(in(-1000, 1000)), "height of the crest; negative: a trough", self.height_m);
    visit("width_m", "m", in(0.1, kFarAway_m), "full width at half height", self.width_m);
  }
  layers::Form form() const { return static_cast<const relief::Ridge&>(*this); }
};

/// How strong a spectrum is.
struct RmsStrength {
  double rms_m = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("rms_m", "m", must(in(0, 10000)), "standard deviation of the height", self.rms_m);
  }
};
struct SedimentStrength {
  std::string sediment;

  static void parameters(auto& self, auto&& visit) {
    visit("as_sediment", "", must(any()), "sediment of APL-UW TR 9407 whose roughness is continued, instead",
          self.sediment);
  }
  void check(const ConfigReader& from) const;
};

struct Spectral : layers::Spectral {
  static constexpr const char *kKey = "spectral", *kAbout = "relief of a spectrum, plain or multifractal";
  std::variant<RmsStrength, SedimentStrength> strength;
  std::optional<Mask> rough_places;
  static void parameters(auto& self, auto&& visit) {
    visit("outer_scale_m", "m", must(in(1e-3, 1e6)), "longer waves grow no higher", self.spectrum.outer_scale_m);
    visit("inner_scale_m", "m", in(0, 1e6), "shorter waves are left out; 0: down to the posts and below",
          self.spectrum.inner_scale_m);
    visit("hurst", "", in(0.01, 1), "roughness: near 0 rough, near 1 smooth", self.spectrum.hurst);
    visit("mean_m", "m", in(-1000, 1000), "mean height", self.mean_m);
    visit("intermittency", "", in(0, 0.7), "variation of roughness from one part to another", self.intermittency);
    visit("height_gain", "", in(-1, 1), "gain of roughness with height: high parts are rougher", self.height_gain);
    visit("smooth_amplitude", "", computed(in(0, 1)), "amplitude where `rough` does not hold", self.smooth_amplitude);
    visit(one_form("needs rms_m, or as_sediment (a sediment whose roughness goes on)", ""), self.strength);
    visit("rough", "mask of rough places, octave by octave", self.rough_places);
  }
  void check(const ConfigReader& from) const;
  layers::Form form() const;
};

struct Ripples : relief::RippleParameters {
  static constexpr const char *kKey = "ripples", *kAbout = "ripples or dunes";
  std::optional<double> crest_m;

  static void parameters(auto& self, auto&& visit) {
    visit("wavelength_m", "m", must(in(1e-2, 10000)), "distance from crest to crest", self.wavelength_m);
    visit("height_m", "m", in(0, 100), "crest to trough, mean; left out: 0.65 of Flemming's", self.crest_m);
    visit("travel_heading_deg", "deg", heading(), "heading that the lee sides face; crests run across it",
          self.travel_heading_rad);
    visit("lee_fraction", "", in(0.3, 0.5), "part of the wavelength under the lee side", self.lee_fraction);
    visit("disorder", "", in(0, 1),
          "disorder of the crests: 0 straight and endless; towards 1 bent, short, forked ones", self.disorder);
    visit("patch_wavelengths", "", in(0.1, 1000), "wavelengths over which crests bend and heights change",
          self.patch_wavelengths);
    visit("height_ln_sd", "", in(0, 1), "standard deviation of the height's logarithm, over the seabed",
          self.height_ln_sd);
  }
  layers::Form form() const;
};

template <relief::BodyShape of>
struct Bodies : relief::BodyParameters {
  static constexpr const char* kKey = of == relief::BodyShape::kBoulder ? "boulders"
                                      : of == relief::BodyShape::kMound ? "mounds"
                                                                        : "pockmarks";
  static constexpr const char* kAbout = kKey;

  Bodies() {
    shape = of;
    if (of != relief::BodyShape::kBoulder) height_per_radius = 0.2;
  }
  static void parameters(auto& self, auto&& visit) {
    visit("per_km2", "1/km^2", must(in(0, 1e8)), "number of the smallest radius and above", self.per_km2);
    visit("smallest_radius_m", "m", must(in(1e-3, 1000)), "radius of the smallest bodies", self.smallest_radius_m);
    visit("largest_radius_m", "m", must(in(1e-3, 1000)), "radius of the largest bodies", self.largest_radius_m);
    visit("size_exponent", "", in(0.01, 20), "the number above a radius goes as radius to the power of minus this",
          self.size_exponent);
    visit("height_per_radius", "", computed(in(0, 10)), "mean; left out: boulders 0.8, else 0.2",
          self.height_per_radius);
    visit("height_ln_sd", "", in(0, 2), "standard deviation of the logarithm of height over radius", self.height_ln_sd);
    visit("elongation", "", in(1, 4), "longer over shorter half axis, at most; the area stays", self.elongation);
  }
  void check(const ConfigReader& from) const;
  layers::Form form() const { return static_cast<const relief::BodyParameters&>(*this); }
};

/// Furrows: pairs of a trawl's doors, or single ones of anchors.
struct Marks : relief::MarkParameters {
  std::array<double, 2> half_width_m{least_half_width_m, most_half_width_m};

  static void parameters(auto& self, auto&& visit) {
    visit("per_km2", "1/km^2", must(in(0, 1e5)), "number of tracks", self.tracks_per_km2);
    visit("length_m", "m", in(0.1, 50000), "length of a track", self.length_m);
    visit("heading_deg", "deg", heading(), "mean of the tracks", self.heading_rad);
    visit("heading_sd_deg", "deg", in(0, 180), "standard deviation of the heading between tracks", self.heading_sd_rad);
    visit("curvature_sd_1pm", "1/m", in(0, 1), "curvature of the tracks, standard deviation", self.curvature_sd_1pm);
    visit("half_width_m", "m", in(0, 10000), "half widths: [least, most]", self.half_width_m);
    visit("depth_m", "m", in(0, 100), "depth of a fresh one", self.depth_m);
    visit("faded", "", in(0, 1), "the share of its depth that a track has lost is uniform from 0 to this", self.faded);
    visit("spoil", "", in(0, 1), "height of the spoil, of the depth", self.spoil);
  }
  void check(const ConfigReader& from) const;
  relief::MarkParameters si(const std::array<double, 2>& spacing_m) const;
};
struct AnchorDrags : Marks {
  static constexpr const char *kKey = "anchor_drags", *kAbout = "single furrows";
  layers::Form form() const { return si({0.0, 0.0}); }
};
struct TrawlScars : Marks {
  static constexpr const char *kKey = "trawl_scars", *kAbout = "pairs of furrows";
  std::array<double, 2> spacing_m{least_spacing_m, most_spacing_m};

  static void parameters(auto& self, auto&& visit) {
    Marks::parameters(self, visit);
    visit("spacing_m", "m", in(0, 10000), "spacings of a pair: [least, most]", self.spacing_m);
  }
  void check(const ConfigReader& from) const;
  layers::Form form() const { return si(spacing_m); }
};

struct Dredged {
  static constexpr const char *kKey = "dredged", *kAbout = "a channel, cut into the seabed";
  std::vector<std::array<double, 3>> line_m;
  double half_width_m = layers::Dredged{}.half_width_m;
  double side_slope_deg = 11.3;  // 1:5

  static void parameters(auto& self, auto&& visit) {
    visit("line_m", "m", must(place()), "two places or more: east, north, depth", self.line_m);
    visit("half_width_m", "m", must(in(1e-2, kFarAway_m)), "half width of the channel's bottom", self.half_width_m);
    visit("side_slope_deg", "", in(0.1, 80), "slope of its sides, degrees", self.side_slope_deg);
  }
  void check(const ConfigReader& from) const;
  layers::Form form() const;
};

struct GuideRaster {
  std::string raster;
  bool are_depths = false;

  static void parameters(auto& self, auto&& visit) {
    visit("raster", "", must(path()), "a file that GDAL reads", self.raster);
    visit("values", "", must(one_of({{"elevation", false}, {"depth", true}})),
          "sign of a raster's values: positive up or down", self.are_depths);
  }
};
struct GuideTiles {
  std::string tiles;

  static void parameters(auto& self, auto&& visit) {
    visit("tiles", "", must(path()), "folder of a tile set, instead of a raster", self.tiles);
  }
};
struct Guide {
  static constexpr const char *kKey = "guide", *kAbout = "a macro shape from a file";
  std::variant<GuideRaster, GuideTiles> file;
  double cell_m = layers::Guide{}.cell_m;

  static void parameters(auto& self, auto&& visit) {
    visit(one_form("needs one of raster (a file that GDAL reads) and tiles (the folder of a tile set)", ""), self.file);
    visit("cell_m", "m", must(in(1e-2, 1000)), "cell of the smooth surface through the guide", self.cell_m);
  }
  void check(const ConfigReader& from) const;
  layers::Form form() const;
};

struct Restored : layers::Restored {
  static constexpr const char *kKey = "restored", *kAbout = "detail that a guide of coarse cells lacks";
  static void parameters(auto& self, auto&& visit) {
    visit("guide", "", must(any()), "the layer whose detail is restored", self.guide);
    visit("hurst", "", in(0.01, 1), "roughness of the detail", self.hurst);
    visit("band_start_cells", "", in(2, 16), "longest waves that are restored, in cells", self.band_start_cells);
  }
  layers::Form form() const { return static_cast<const layers::Restored&>(*this); }
};

/// A term under its key.
template <class Term>
struct Is {
  Term term;
  static void parameters(auto& self, auto&& visit) { visit(Term::kKey, Term::kAbout, self.term); }
  layers::Form form() const { return term.form(); }
};
/// No height: gives a sediment class where the mask holds.
struct Paint {
  static void parameters(auto&, auto&&) {}
  layers::Form form() const { return layers::Paint{}; }
};
using Boulders = Bodies<relief::BodyShape::kBoulder>;
using Mounds = Bodies<relief::BodyShape::kMound>;
using Pockmarks = Bodies<relief::BodyShape::kPockmark>;

struct Layer {
  using Join = relief::Layer::Join;
  using Form = std::variant<Is<Plane>, Is<Ramp>, Is<Wave>, Is<Sphere>, Is<Guide>, Is<Restored>, Is<Ridge>, Is<Spectral>,
                            Is<Ripples>, Is<Boulders>, Is<Mounds>, Is<Pockmarks>, Is<TrawlScars>, Is<AnchorDrags>,
                            Is<Dredged>, Paint>;
  std::string name;
  static constexpr auto kNamedBy = &Layer::name;
  bool use = true;
  std::optional<Join> join;
  std::optional<std::uint8_t> sediment;
  double shows_above_m = 0.0;
  std::string above;
  std::optional<Mask> mask;
  Form is = Paint{};

  static void parameters(auto& self, auto&& visit) {
    visit("use", "", any(), "false: as if it were not there", self.use);
    visit("join", "", one_of({{"add", Join::kAdd}, {"cover", Join::kCover}, {"cut", Join::kCut}}),
          "way to join the guide to what lies below: add to it, the higher of both, the lower of both", self.join);
    visit("sediment", "", in(0, 255), "class where the mask is a half or more and the layer moved the seabed",
          self.sediment);
    visit("shows_above_m", "m", in(0, 1000), "change of the seabed by the layer beyond which its class shows",
          self.shows_above_m);
    visit("above", "", computed(any()), "base of cover and cut: heights count from the seabed up to this layer",
          self.above);
    visit("mask", "mask where the layer applies; heights are multiplied by it", self.mask);
    visit(one_form("", "a layer is one thing, make two of it"), self.is);
  }
  void check(const ConfigReader& from) const;
  Join joined() const;
  layers::Layer layer() const;
};

/// Names of layers must be of those further up; `from` has the list.
void check_names(const ConfigReader& from, const std::vector<Layer>& layers);

}  // namespace ensonify::terms

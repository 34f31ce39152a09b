#include "scenarios/world/seabed.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "components/config/config_node.h"
#include "components/config/read_parameters.h"
#include "scenarios/world/sections.h"

namespace ensonify {

namespace {

double ratio_of(double db) { return std::pow(10.0, 0.1 * db); }

LayeredSeabed read_layered(ConfigReader& from) {
  LayeredSeabed seabed;
  read_parameters(from, seabed);
  if (from.has("layers")) seabed.layers = read_layers(from);
  if (seabed.layers.empty()) from.problem("layers", "is empty; at least one layer is needed");
  return seabed;
}

RasterSeabed read_raster(ConfigReader from) {
  RasterSeabed raster;
  read_parameters(from, raster);
  return raster;
}

/// A name of TR 9407's table 2.
std::optional<seabed::SedimentParameters> read_name(ConfigReader& from, const std::string& key) {
  std::string name;
  from.required(key, name);
  if (const auto found = seabed::sediment_of(name)) return found;
  std::string known;
  for (const auto& sediment : seabed::named_sediments()) {
    known += (known.empty() ? "" : ", ") + std::string(sediment.name);
  }
  from.problem(key, "is \"" + name + "\", not one of " + known);
  return std::nullopt;
}

/// The six parameters, within the limits that TR 9407 states.
struct SixParameters : seabed::SedimentParameters {
  static void parameters(auto& self, auto&& visit) {
    visit("density_ratio", "", must(in(1, 3)), "of the sediment over the water's", self.density_ratio);
    visit("sound_speed_ratio", "", must(in(0.8, 3)), "of the sediment over the water's", self.sound_speed_ratio);
    visit("loss", "", must(in(1e-6, 0.1)), "imaginary over real wavenumber in the sediment", self.loss);
    visit("volume_parameter", "", must(in(0, 1)), "volume scattering over attenuation cross section",
          self.volume_parameter);
    visit("spectral_exponent", "", in(2.4, 3.9), "of the relief spectrum", self.spectral_exponent);
    visit("spectral_strength_cm4", "", must(in(1e-9, 1)), "of the relief spectrum, in cm^4",
          self.spectral_strength_cm4);
  }
};

struct GsabInFile {
  double specular_db = 0.0, diffuse_db = 0.0;
  std::optional<double> transition_db;
  seabed::Gsab curve;

  static void parameters(auto& self, auto&& visit) {
    visit("specular_db", "dB", must(in(-100, 20)), "level at normal incidence", self.specular_db);
    visit("specular_width_deg", "deg", must(in(0.1, 90)), "width of the specular peak", self.curve.specular_width_rad);
    visit("diffuse_db", "dB", must(in(-100, 0)), "level of the diffuse part", self.diffuse_db);
    visit("diffuse_exponent", "", in(0, 20), "of the cosine of incidence; 2 is Lambert's law",
          self.curve.diffuse_exponent);
    visit("transition_db", "dB", in(-100, 20), "level of a shoulder at moderate incidence; left out: none",
          self.transition_db);
    visit("transition_width_deg", "deg", in(0.1, 90), "width of that shoulder", self.curve.transition_width_rad);
  }
};

struct Diffuser {
  seabed::Lambert lambert;

  static void parameters(auto& self, auto&& visit) {
    // A perfect diffuser has -4.97 dB.
    visit("lambert_mu_db", "dB", must(in(-60, -4.97)), "Lambert's law with this strength at normal incidence",
          self.lambert.mu_db);
  }
};
struct Grain {
  double size_phi = 1.5;

  static void parameters(auto& self, auto&& visit) {
    visit("grain_size_phi", "", must(in(-1, 9)), "the sediment by its mean grain size", self.size_phi);
  }
};
struct OfSediment {
  bool capped = false;
  std::optional<double> slope_deg;

  static void parameters(auto& self, auto&& visit) {
    visit("capped", "", any(), "no more than a diffuse reflector returns: for rock above 100 kHz", self.capped);
    visit("facet_slope_deg", "", in(0, 35), "slope of facets in degrees: what of the relief the heights have",
          self.slope_deg);
  }
};

seabed::Gsab read_gsab(ConfigReader from) {
  GsabInFile file;
  read_parameters(from, file);
  seabed::Gsab curve = file.curve;
  curve.specular = ratio_of(file.specular_db);
  curve.diffuse = ratio_of(file.diffuse_db);
  if (file.transition_db) curve.transition = ratio_of(*file.transition_db);
  return curve;
}

/// A map that states the seabed in one of five ways.
std::optional<seabed::Scatterer> read_scatterer(ConfigReader from) {
  static constexpr std::array kWays = {"name", "grain_size_phi", "density_ratio", "lambert_mu_db", "gsab"};
  std::string way;
  for (const char* key : kWays) {
    if (!from.has(key)) continue;
    if (!way.empty()) from.problem(key, "stands beside " + way + "; give one or the other");
    way = key;
  }
  if (way.empty()) {
    from.problem("", "needs one of name, grain_size_phi, density_ratio (with the other five), lambert_mu_db, gsab");
    return std::nullopt;
  }
  if (way == "lambert_mu_db") {
    Diffuser diffuser;
    read_parameters(from, diffuser);
    return diffuser.lambert;
  }
  if (way == "gsab") return read_gsab(from.section("gsab"));
  std::optional<seabed::SedimentParameters> sediment;
  if (way == "name") sediment = read_name(from, "name");
  if (way == "density_ratio") {
    SixParameters six;
    read_parameters(from, six);
    sediment = six;
  }
  if (way == "grain_size_phi") {
    Grain grain;
    read_parameters(from, grain);
    sediment = seabed::sediment_of_grain_size(grain.size_phi);
  }
  OfSediment more;
  read_parameters(from, more);
  const auto& [capped, slope_deg] = more;
  if (!sediment) return std::nullopt;
  if (slope_deg && capped) return on_facets(seabed::CappedSediment{*sediment}, *slope_deg);
  if (slope_deg) return on_facets(*sediment, *slope_deg);
  if (capped) return seabed::CappedSediment{*sediment};
  return *sediment;
}

/// Class number to a name, or to a map (read_scatterer).
void read_sediments(ConfigReader from, Seabed& seabed) {
  for (const auto& entry : from.node().entries) {
    const auto number = parse_natural(entry.key);
    std::optional<seabed::Scatterer> scatterer;
    if (entry.value.is_scalar()) scatterer = read_name(from, entry.key);
    else scatterer = read_scatterer(from.section(entry.key));
    if (!number || *number > 255) {
      from.problem(entry.key, "is not a class of the seabed, a whole number in [0, 255]");
    } else if (scatterer) {
      seabed.sediments[static_cast<std::uint8_t>(*number)] = *scatterer;
    }
  }
}

Allowed names_of_sediments() {
  Allowed names;
  for (const auto& sediment : seabed::named_sediments()) names.words.emplace_back(std::string(sediment.name).c_str());
  for (const auto& other : seabed::other_sediment_names()) names.words.emplace_back(std::string(other.first).c_str());
  return names;
}

ParameterList sediment_list() {
  ParameterList list{word_info("name", "a sediment of APL-UW TR 9407", names_of_sediments())};
  const ParameterList gsab{section_info("gsab", "a curve of six numbers", parameters_of<GsabInFile>())};
  for (const ParameterList& part : {parameters_of<Grain>(), parameters_of<SixParameters>(), parameters_of<Diffuser>(),
                                    gsab, parameters_of<OfSediment>()}) {
    for (ParameterInfo info : part) {
      info.allowed.required = false;  // one of five ways
      list.push_back(std::move(info));
    }
  }
  return list;
}

constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace

ParameterList seabed_list() {
  ParameterList list = parameters_of<Seabed>();
  for (ParameterInfo& info : parameters_of<LayeredSeabed>()) list.push_back(std::move(info));
  list.push_back(words_or_maps_info("sediments", "what the classes of posts are made of, by number", "^[0-9]+$",
                                    names_of_sediments(), sediment_list()));
  list.push_back(named_info("layers", "of a generated seabed, from the bottom up", layer_list()));
  list.push_back(section_info("raster", "an imported raster", parameters_of<RasterSeabed>()));
  list.push_back(section_info("tiles", "an imported tile set", {file_info("folder", "of the tile set")}));
  list.push_back(named_info("meshes", "what stands in the seabed", meshes_list()));
  return list;
}

Seabed read_seabed(ConfigReader from) {
  Seabed seabed;
  read_parameters(from, seabed);
  if (const auto sediments = from.optional_section("sediments")) {
    read_sediments(*sediments, seabed);
  }
  read_meshes(from, seabed);
  const std::array<std::pair<Seabed::Kind, const char*>, 5> sections = {{{Seabed::Kind::kLayers, "layers"},
                                                                         {Seabed::Kind::kLayers, "size_m"},
                                                                         {Seabed::Kind::kLayers, "centre_m"},
                                                                         {Seabed::Kind::kRaster, "raster"},
                                                                         {Seabed::Kind::kTiles, "tiles"}}};
  for (const auto& [kind, key] : sections) {
    if (kind != seabed.kind && from.has(key)) from.problem(key, "is not used by this kind of seabed");
  }
  switch (seabed.kind) {
    case Seabed::Kind::kLayers: seabed.layered = read_layered(from); break;
    case Seabed::Kind::kRaster: seabed.raster = read_raster(from.section("raster")); break;
    case Seabed::Kind::kTiles: from.section("tiles").required_path("folder", seabed.tiles_folder); break;
  }
  return seabed;
}

seabed::MeshedSediment on_facets(const std::variant<seabed::SedimentParameters, seabed::CappedSediment>& whole,
                                 double facet_slope_deg) {
  const double slope = std::tan(facet_slope_deg * kDegree);
  return {whole, slope * slope};
}

std::map<std::uint8_t, seabed::Scatterer> on_mesh(std::map<std::uint8_t, seabed::Scatterer> sediments,
                                                  std::span<const double> mean_square_slope) {
  for (auto& [number, scatterer] : sediments) {
    if (number >= mean_square_slope.size() || mean_square_slope[number] == 0.0) continue;
    const double slope = mean_square_slope[number];
    if (const auto* plain = std::get_if<seabed::SedimentParameters>(&scatterer)) {
      scatterer = seabed::MeshedSediment{*plain, slope};
    } else if (const auto* capped = std::get_if<seabed::CappedSediment>(&scatterer)) {
      scatterer = seabed::MeshedSediment{*capped, slope};
    }
  }
  return sediments;
}

double facet_slope_deg(const seabed::MeshedSediment& meshed) {
  return std::atan(std::sqrt(meshed.mean_square_slope)) / kDegree;
}

}  // namespace ensonify

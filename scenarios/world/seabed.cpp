#include "scenarios/world/seabed.h"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "components/config/scalars.h"
#include "scenarios/world/facet_slope.h"
#include "scenarios/world/sections.h"

namespace ensonify {
namespace {

double ratio_of(double db) { return std::pow(10.0, 0.1 * db); }

LayeredSeabed read_layered(ConfigReader& from) {
  LayeredSeabed seabed;
  std::array<double, 2> size{seabed.size_m.x(), seabed.size_m.y()}, centre{};
  from.optional("size_m", size, 0.1, kFarAway_m);
  from.optional("centre_m", centre, -kFarAway_m, kFarAway_m);
  seabed.size_m = {size[0], size[1]};
  seabed.centre_enu_m = {centre[0], centre[1]};
  if (from.has("layers")) seabed.layers = read_layers(from);
  if (seabed.layers.empty()) from.problem("layers", "is empty; at least one layer is needed");
  return seabed;
}

RasterSeabed read_raster(ConfigReader from) {
  RasterSeabed raster;
  from.required_path("path", raster.path);
  from.required_choice("values", raster.values,
                       {{"elevation", RasterSeabed::Values::kElevation}, {"depth", RasterSeabed::Values::kDepth}});
  from.optional_choice("holes", raster.holes,
                       {{"refuse", RasterSeabed::Holes::kRefuse},
                        {"keep", RasterSeabed::Holes::kKeep},
                        {"fill", RasterSeabed::Holes::kFill}});
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
seabed::SedimentParameters read_parameters(ConfigReader& from) {
  seabed::SedimentParameters sediment;
  from.required("density_ratio", sediment.density_ratio, 1, 3);
  from.required("sound_speed_ratio", sediment.sound_speed_ratio, 0.8, 3);
  from.required("loss", sediment.loss, 1e-6, 0.1);
  from.required("volume_parameter", sediment.volume_parameter, 0, 1);
  from.optional("spectral_exponent", sediment.spectral_exponent, 2.4, 3.9);
  from.required("spectral_strength_cm4", sediment.spectral_strength_cm4, 1e-9, 1);
  return sediment;
}

seabed::Gsab read_gsab(ConfigReader from) {
  double specular_db = 0.0, diffuse_db = 0.0;
  std::optional<double> transition_db;
  seabed::Gsab curve;
  from.required("specular_db", specular_db, -100, 20);
  from.required("specular_width_deg", curve.specular_width_rad, 0.1, 90, kDegrees);
  from.required("diffuse_db", diffuse_db, -100, 0);
  from.optional("diffuse_exponent", curve.diffuse_exponent, 0, 20);
  from.optional("transition_db", transition_db, -100, 20);
  from.optional("transition_width_deg", curve.transition_width_rad, 0.1, 90, kDegrees);
  curve.specular = ratio_of(specular_db);
  curve.diffuse = ratio_of(diffuse_db);
  if (transition_db) curve.transition = ratio_of(*transition_db);
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
    seabed::Lambert lambert;
    from.required("lambert_mu_db", lambert.mu_db, -60, -4.97);  // a perfect diffuser has -4.97 dB
    return lambert;
  }
  if (way == "gsab") return read_gsab(from.section("gsab"));
  std::optional<seabed::SedimentParameters> sediment;
  bool capped = false;
  if (way == "name") sediment = read_name(from, "name");
  if (way == "density_ratio") sediment = read_parameters(from);
  if (way == "grain_size_phi") {
    double grain_size_phi = 1.5;
    from.required("grain_size_phi", grain_size_phi, -1, 9);
    sediment = seabed::sediment_of_grain_size(grain_size_phi);
  }
  from.optional("capped", capped);
  std::optional<double> slope_deg;  // of facets: what of the relief the heights have
  from.optional("facet_slope_deg", slope_deg, 0, 35);
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

}  // namespace

Seabed read_seabed(ConfigReader from) {
  Seabed seabed;
  from.required_choice(
      "kind", seabed.kind,
      {{"layers", Seabed::Kind::kLayers}, {"raster", Seabed::Kind::kRaster}, {"tiles", Seabed::Kind::kTiles}});
  from.optional("post_spacing_m", seabed.post_spacing_m, 0.005, 100);
  from.optional("lsb_m", seabed.lsb_m, 1e-6, 1);
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

}  // namespace ensonify

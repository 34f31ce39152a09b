#include "scenarios/world/seabed.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "components/config/config_node.h"
#include "components/config/read_parameters.h"
#include "scenarios/world/seabed_keys.h"

namespace ensonify {

namespace {

double ratio_of(double db) { return std::pow(10.0, 0.1 * db); }

constexpr double kDegree = std::numbers::pi / 180.0;

std::optional<seabed::Scatterer> scatterer_of(const NamedSediment& of) {
  const auto sediment = seabed::sediment_of(of.name);
  return sediment ? std::optional(of.of(*sediment)) : std::nullopt;
}
std::optional<seabed::Scatterer> scatterer_of(const GrainSediment& of) {
  return of.of(seabed::sediment_of_grain_size(of.size_phi));
}
std::optional<seabed::Scatterer> scatterer_of(const MeasuredSediment& of) { return of.of(of.six); }
std::optional<seabed::Scatterer> scatterer_of(const LambertSediment& of) { return of.lambert; }
std::optional<seabed::Scatterer> scatterer_of(const GsabSediment& of) {
  seabed::Gsab curve = of.gsab.curve;
  curve.specular = ratio_of(of.gsab.specular_db);
  curve.diffuse = ratio_of(of.gsab.diffuse_db);
  if (of.gsab.transition_db) curve.transition = ratio_of(*of.gsab.transition_db);
  return curve;
}

}  // namespace

Allowed names_of_sediments() {
  Allowed names;
  for (const auto& sediment : seabed::named_sediments()) names.words.emplace_back(std::string(sediment.name).c_str());
  for (const auto& other : seabed::other_sediment_names()) names.words.emplace_back(std::string(other.first).c_str());
  return names;
}

seabed::Scatterer FacetKeys::of(const seabed::SedimentParameters& sediment) const {
  if (slope_deg && capped) return on_facets(seabed::CappedSediment{sediment}, *slope_deg);
  if (slope_deg) return on_facets(sediment, *slope_deg);
  if (capped) return seabed::CappedSediment{sediment};
  return sediment;
}

std::optional<seabed::Scatterer> SedimentKeys::scatterer() const {
  return std::visit([](const auto& of) { return scatterer_of(of); }, form);
}

SeabedKeys::SeabedKeys() {
  NamedSediment sand;
  sand.name = "medium sand";
  sediments[0].form = sand;
}

void GeneratedSeabed::check(const ConfigReader& from) const {
  if (layers.empty()) from.problem("layers", "is empty; at least one layer is needed");
  terms::check_names(from, layers);
}

void SeabedKeys::check(const ConfigReader& from) const {
  for (const MeshKeys& mesh : meshes) {
    if (!sediments.contains(mesh.sediment)) {
      from.problem("meshes." + mesh.name + ".sediment", "is not a class of seabed.sediments");
    }
  }
}

Seabed SeabedKeys::seabed() const {
  Seabed seabed = values;
  seabed.kind = static_cast<Seabed::Kind>(kind.index());
  for (const auto& [number, sediment] : sediments) {
    if (const auto scatterer = sediment.scatterer()) seabed.sediments[number] = *scatterer;
  }
  for (const MeshKeys& mesh : meshes) seabed.meshes.push_back(mesh.mesh());
  if (const auto* generated = std::get_if<GeneratedSeabed>(&kind)) {
    seabed.layered = generated->values;
    seabed.layered.layers.clear();
    for (const terms::Layer& layer : generated->layers) seabed.layered.layers.push_back(layer.layer());
  }
  if (const auto* of = std::get_if<SeabedOfRaster>(&kind)) seabed.raster = of->raster;
  if (const auto* of = std::get_if<SeabedOfTiles>(&kind)) seabed.tiles_folder = of->tiles.folder;
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

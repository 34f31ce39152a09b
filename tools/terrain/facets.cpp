#include "tools/terrain/facets.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "components/errors/exit_error.h"
#include "components/terrain/layers_source.h"
#include "scenarios/world/facet_slope.h"
#include "scenarios/world/world.h"
#include "tools/terrain/verbs.h"

namespace ensonify::terrain_tool {
namespace {

int facets(const std::string& file) {
  const World world = read_world(file);
  if (world.seabed.kind != Seabed::Kind::kLayers)
    throw UserError(file + ": is no seabed of layers; of others the scenario says facet_slope_deg itself");
  print_facets(world.seabed, source::LayersSource(world.seabed, world.site.origin).meshed_relief());
  return kExitOk;
}

}  // namespace

void print_facets(const Seabed& seabed, const source::MeshedRelief& relief) {
  if (seabed.kind != Seabed::Kind::kLayers) return;
  for (const auto& [number, scatterer] : on_mesh(seabed.sediments, relief.mean_square_slope)) {
    const auto* meshed = std::get_if<seabed::MeshedSediment>(&scatterer);
    if (meshed == nullptr || meshed->mean_square_slope == 0.0) continue;
    fmt::print("class {}: a scenario on tiles of this seabed says facet_slope_deg: {:.4f} of its sediment\n", number,
               facet_slope_deg(*meshed));
  }
  for (const auto& uneven : relief.uneven) fmt::print("warning: {}\n", source::text_of(uneven));
}

Verb add_facets(CLI::App& parent) {
  auto file = std::make_shared<std::string>();
  CLI::App* app = parent.add_subcommand(
      "facets",
      "Says what of its sediments' roughness the facets of a seabed of layers have, and which class is uneven.");
  app->add_option("scenario", *file, "scenario file (YAML)")->required()->check(CLI::ExistingFile);
  return {app, [file] { return facets(*file); }};
}

}  // namespace ensonify::terrain_tool

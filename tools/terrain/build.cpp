#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "components/config/config_node.h"
#include "components/config/config_text.h"
#include "components/config/data_paths.h"
#include "components/config/parse_yaml.h"
#include "components/errors/exit_error.h"
#include "components/terrain/layers_source.h"
#include "components/terrain/source_of.h"
#include "scenarios/world/seabed.h"
#include "scenarios/world/world.h"
#include "tools/terrain/bake.h"
#include "tools/terrain/verbs.h"

namespace ensonify::terrain_tool {
namespace {

struct Options {
  std::string scenario;
  BakeOptions bake;
  std::optional<double> lsb_m;
  std::string raster_crs;
  int raster_band = 1;
  std::optional<double> raster_nodata;
};

/// What the tiles follow from; equal texts give equal tiles.
std::string source_text(const Options& options) {
  const std::string found = find_data(options.scenario, {""});
  const ConfigDocument document = load_scenario(found.empty() ? options.scenario : found);
  return fmt::format(
             "# what these tiles were built from\nlsb_m: {}\ncells: {}\nraster_band: {}\nraster_crs: "
             "\"{}\"\nraster_nodata: {}\n",
             options.lsb_m ? fmt::format("{}", *options.lsb_m) : "the scenario's", options.bake.cells,
             options.raster_band, options.raster_crs,
             options.raster_nodata ? fmt::format("{}", *options.raster_nodata) : "none") +
         "scenario:\n" + to_canonical_yaml(document.root);
}

/// Prints what laws of a layered seabed's sediments must know of its facets, and where one law cannot do for all of a
/// class; nothing for other seabeds.
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

int facets(const std::string& file) {
  const World world = read_world(file);
  if (world.seabed.kind != Seabed::Kind::kLayers)
    throw UserError(file + ": is no seabed of layers; of others the scenario says facet_slope_deg itself");
  print_facets(world.seabed, source::LayersSource(world.seabed, world.site.origin).meshed_relief());
  return kExitOk;
}

int build(const Options& options) {
  const World world = read_world(options.scenario);
  const source::TerrainOptions terrain{world.site, world.seabed, options.raster_crs, options.raster_band,
                                       options.raster_nodata};
  const auto source = source::source_of(terrain);
  claim(options.bake.folder, source_text(options));
  tiles::TileSet set;
  set.folder = options.bake.folder;
  set.origin = source->origin();
  set.grid = {frames::Vec2::Zero(), source::post_spacing_m(terrain, *source), options.bake.cells,
              options.lsb_m.value_or(source::lsb_m(terrain, *source))};
  set.made_from = std::filesystem::path(options.scenario).parent_path().filename().string() + "/" +
                  std::filesystem::path(options.scenario).filename().string();
  if (!bake(*source, options.scenario, options.bake.threads, set)) return kExitInterrupted;
  fmt::print("{}: {} tiles of {} x {} posts {} m apart\n", set.folder, set.tiles.size(), set.grid.cells + 1,
             set.grid.cells + 1, set.grid.spacing_m);
  print_facets(world.seabed, source->meshed_relief());  // a scenario on the tiles knows no layers
  return kExitOk;
}

}  // namespace

Verb add_build(CLI::App& parent) {
  auto options = std::make_shared<Options>();
  CLI::App* app = parent.add_subcommand(
      "build", "Bakes a scenario's seabed into a tile set. A build that was stopped goes on where it was.");
  app->add_option("scenario", options->scenario, "scenario file (YAML)")->required()->check(CLI::ExistingFile);
  app->add_option("folder", options->bake.folder, "folder of the tile set, made if need be")->required();
  app->add_option("--lsb-m", options->lsb_m, "step of heights, m, instead of the scenario's")
      ->check(CLI::Range(1e-6, 10.0));
  options->bake.add_to(*app);
  app->add_option("--raster-crs", options->raster_crs, "reference system of a raster that names none, e.g. EPSG:32619");
  app->add_option("--raster-band", options->raster_band, "band of a raster")->capture_default_str();
  app->add_option("--raster-nodata", options->raster_nodata, "mark for missing values of a raster that declares none");
  return {app, [options] { return build(*options); }};
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

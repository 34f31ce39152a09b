// ensonify terrain: seabeds on disk.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "components/errors/exit_error.h"
#include "components/runtime/tool.h"
#include "components/terrain/tile_set_source.h"
#include "scenarios/world/world.h"
#include "tools/terrain/verbs.h"

namespace ensonify::terrain_tool {

Opened open_seabed(const std::string& scenario_or_folder) {
  Opened opened;
  if (std::filesystem::is_directory(scenario_or_folder)) {
    opened.terrain = std::make_unique<source::TileSetSource>(scenario_or_folder);
    opened.spacing_m = opened.terrain->native_spacing_m();
    opened.lsb_m = opened.terrain->lsb_m().value_or(opened.lsb_m);
    return opened;
  }
  const World world = read_world(scenario_or_folder);
  const source::TerrainOptions options{world.site, world.seabed, "", 1, {}};
  opened.terrain = source::source_of(options);
  opened.spacing_m = source::post_spacing_m(options, *opened.terrain);
  opened.lsb_m = source::lsb_m(options, *opened.terrain);
  opened.meshes = world.seabed.meshes;
  opened.objects = world.objects;
  opened.seed = world.seed;
  if (world.seabed.kind == Seabed::Kind::kLayers) opened.layered = world.seabed.layered;
  return opened;
}

}  // namespace ensonify::terrain_tool

int main(int argc, char** argv) {
  using namespace ensonify;
  CLI::App app(
      "Seabeds: makes, checks and reads tile sets (docs/manual/tiles.md), draws and measures generated seabeds.\n"
      "Exit code: 0 done, 1 verify found a fault, 2 wrong input or a file that cannot be read or written.",
      "ensonify terrain");
  app.require_subcommand(1);
  const std::vector<terrain_tool::Verb> verbs = {
      terrain_tool::add_build(app),  terrain_tool::add_import(app), terrain_tool::add_info(app),
      terrain_tool::add_verify(app), terrain_tool::add_sample(app), terrain_tool::add_plot(app),
      terrain_tool::add_truth(app),  terrain_tool::add_grid(app),   terrain_tool::add_mesh(app),
      terrain_tool::add_lod(app),    terrain_tool::add_marks(app),  terrain_tool::add_facets(app),
      terrain_tool::add_objects(app)};
  return tool_main(app, argc, argv, [&] {
    for (const auto& verb : verbs) {
      if (verb.app->parsed()) return verb.run();
    }
    return static_cast<int>(kExitOk);
  });
}

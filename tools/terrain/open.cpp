#include "tools/terrain/open.h"

#include <filesystem>

#include "components/terrain/tile_set_source.h"
#include "scenarios/world/world.h"

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
  opened.seed = world.seed;
  if (world.seabed.kind == Seabed::Kind::kLayers) opened.layered = world.seabed.layered;
  return opened;
}

}  // namespace ensonify::terrain_tool

#include "tools/terrain/open.h"

#include <filesystem>

#include "components/runtime/config/scenario.h"
#include "components/runtime/terrain/tile_set_source.h"

namespace ensonify::terrain_tool {

Opened open_seabed(const std::string& scenario_or_folder) {
  Opened opened;
  if (std::filesystem::is_directory(scenario_or_folder)) {
    opened.terrain = std::make_unique<source::TileSetSource>(scenario_or_folder);
    opened.spacing_m = opened.terrain->native_spacing_m();
    opened.lsb_m = opened.terrain->lsb_m().value_or(opened.lsb_m);
    return opened;
  }
  const Scenario scenario = read_scenario(scenario_or_folder);
  const source::TerrainOptions options{scenario.site, scenario.seabed, "", 1, {}};
  opened.terrain = source::source_of(options);
  opened.spacing_m = source::post_spacing_m(options, *opened.terrain);
  opened.lsb_m = source::lsb_m(options, *opened.terrain);
  opened.meshes = scenario.seabed.meshes;
  opened.seed = scenario.seed;
  if (scenario.seabed.kind == Seabed::Kind::kLayers) opened.layered = scenario.seabed.layered;
  return opened;
}

}  // namespace ensonify::terrain_tool

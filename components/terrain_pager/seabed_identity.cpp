#include "components/terrain_pager/seabed_identity.h"

#include <variant>

#include "components/config/config_node.h"
#include "components/terrain/raster_file.h"
#include "components/terrain/tiles/tile_set.h"
#include "components/terrain_pager/identity.h"

namespace ensonify::pager {
namespace {

std::string scenario_part(const TerrainPagerConfig& config) {
  const ConfigNode world = parse_config(config.scenario_text, config.scenario_file).root;
  ConfigNode part = ConfigNode::map();
  for (const char* section : {"site", "seed", "seabed"}) {
    if (const ConfigNode* found = world.find(section)) part.set(section, *found);
  }
  return to_canonical_yaml(part);
}

std::string guides_of(const LayeredSeabed& seabed) {
  std::string text;
  for (const layers::Layer& layer : seabed.layers) {
    const auto* guide = std::get_if<layers::Guide>(&layer.form);
    if (guide == nullptr) continue;
    if (!guide->tiles_folder.empty()) text += file_identity(guide->tiles_folder + "/" + tiles::kManifest);
    if (!guide->raster.empty()) {
      for (const std::string& file : source::files_of_raster(guide->raster)) text += file_identity(file);
    }
  }
  return text;
}

}  // namespace

std::string seabed_identity(const TerrainPagerConfig& config) {
  return scenario_part(config) + guides_of(config.terrain.seabed.layered) + program_identity();
}

}  // namespace ensonify::pager

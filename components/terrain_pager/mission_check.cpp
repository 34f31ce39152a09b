#include "components/terrain_pager/mission_check.h"

#include <numbers>

#include "components/terrain/source_of.h"
#include "components/terrain_pager/corridor.h"
#include "components/terrain_pager/meshes.h"
#include "components/terrain_pager/mission_track.h"

namespace ensonify::pager {

double check_mission(const source::TerrainSource& terrain, const TerrainPagerConfig& config, Beyond beyond) {
  const auto holes = config.terrain.seabed.kind == Seabed::Kind::kRaster ? config.terrain.seabed.raster.holes
                                                                         : RasterSeabed::Holes::kKeep;
  const MissionTrack track = track_of(config);
  CorridorRules rules;
  rules.half_swath_rad = config.corridor_half_deg * std::numbers::pi / 180.0;
  rules.refuse_holes = beyond == Beyond::kRefused && holes == RasterSeabed::Holes::kRefuse;
  rules.refuse_beyond = beyond == Beyond::kRefused;
  rules.least_altitude_m = config.mission.least_altitude_m;
  rules.lowest_water_m = track.lowest_water_m;
  const double shallowest_m = check_corridors(terrain, track.legs, rules);
  check_places(terrain, track.places, rules);
  return shallowest_m;
}

void check_mission_alone(const TerrainPagerConfig& config) {
  const auto terrain = source::source_of(config.terrain);
  const Meshes meshes(config, *terrain);
  check_mission(*terrain, config, Beyond::kAllowed);
}

}  // namespace ensonify::pager

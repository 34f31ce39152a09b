#pragma once

#include "components/terrain/terrain_source.h"
#include "components/terrain_pager/config.h"

namespace ensonify::pager {

/// Part of a mission that may be beyond the terrain: nothing where tiles of it are needed, else all.
enum class Beyond { kRefused, kAllowed };

/// Holds the scenario's mission and its vehicles' starts against the seabed (corridor.h) and returns the least depth
/// along the runlines. Throws ConfigError with the place of what cannot be run.
double check_mission(const source::TerrainSource& terrain, const TerrainPagerConfig& config, Beyond beyond);

/// The same, and against meshes, for a launch in which no pager runs: opens the seabed that the scenario names. What
/// such a launch runs may be beyond it.
void check_mission_alone(const TerrainPagerConfig& config);

}  // namespace ensonify::pager

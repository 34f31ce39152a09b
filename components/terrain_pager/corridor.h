#pragma once

#include <string>
#include <vector>

#include "components/runtime/terrain/terrain_source.h"
#include "kernels/navigation/runline.h"

namespace ensonify::pager {

using frames::Vec2;
using source::Extent;
using source::TerrainSource;

/// What must be known of the seabed along the runlines.
struct CorridorRules {
  double half_swath_rad = 1.134;  // the corridor reaches tan(half_swath) times the depth to either side
  bool refuse_holes = true;       // else only the lines' ends and the depth under them are asked for
};

/// Throws ConfigError, one problem per runline at most, if a line leaves the terrain or, with refuse_holes, if a place
/// of its corridor inside the terrain has no height. `scenario_file` is the place that the message names.
void check_corridors(const TerrainSource& terrain, const std::vector<navigation::Runline>& runlines,
                     const CorridorRules& rules, const std::string& scenario_file);

/// Least depth under the runlines; without any, of the whole terrain. At least 0.
double shallowest_m(const TerrainSource& terrain, const std::vector<navigation::Runline>& runlines);

}  // namespace ensonify::pager

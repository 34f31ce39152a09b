#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/runtime/config/config_error.h"
#include "components/runtime/terrain/terrain_source.h"
#include "kernels/navigation/runline.h"

namespace ensonify::pager {

using frames::Vec2;
using source::Extent;
using source::TerrainSource;

/// What must be known of the seabed along the runlines, and how deep the vehicle runs there.
struct CorridorRules {
  double half_swath_rad = 1.134;  // the corridor reaches tan(half_swath) times the depth to either side
  bool refuse_holes = true;       // else only the lines' ends and the depth under them are asked for
  /// Of each runline, below chart datum; nothing where it follows the bottom. Fewer than runlines: 0.
  std::vector<std::optional<double>> depth_m = {};
  std::vector<ConfigPlace> place = {};  // of each runline in its file; fewer than runlines: the mission's
  double least_altitude_m = 0.0;        // obstacle floor of a vehicle that dives; 0: none
  bool refuse_beyond = true;            // else a line may leave the terrain
};

/// A place that a mission visits besides its runlines or where a vehicle starts, and how deep.
struct VisitedPlace {
  Vec2 place_enu_m;
  std::optional<double> depth_m;
  ConfigPlace place;            // in the file that says so
  std::string key = "mission";  // there
};

/// Throws ConfigError, one problem per runline at most, if a line leaves the terrain, runs over land (above chart
/// datum) or through the seabed, if all of it is too shallow for the obstacle floor, or, with refuse_holes, if a place
/// of its corridor inside the terrain has no height. `mission` is the place that the message names where the rules name
/// none. A line is looked at in steps of the posts, but at most 2000, and the seabed as posts that far apart show it.
/// Returns the least depth that was looked at; without runlines, of the whole terrain. At least 0.
double check_corridors(const TerrainSource& terrain, const std::vector<navigation::Runline>& runlines,
                       const CorridorRules& rules, const ConfigPlace& mission);

/// The same for places, without corridors.
void check_places(const TerrainSource& terrain, const std::vector<VisitedPlace>& places, bool refuse_beyond = true);

}  // namespace ensonify::pager

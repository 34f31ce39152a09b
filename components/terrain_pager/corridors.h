#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/config/config_error.h"
#include "components/terrain/terrain_source.h"
#include "kernels/vehicle/runlines/runline.h"

namespace ensonify::pager {

using frames::Vec2;
using source::Extent;
using source::TerrainSource;

/// A straight piece of what a mission runs.
struct Leg {
  runlines::Runline line;
  double reach_m = 0.0;              // of the vehicle's lowest part below the water level; at the surface where it
  std::optional<double> altitude_m;  // follows the bottom, this far above it
  ConfigPlace place;                 // in the file that says so
  std::string key = "mission";       // there
  bool surveyed = false;             // its corridor matters too
  double spacing_m = 0.0;            // it is examined no more finely than this
};

/// A place that a mission visits besides its legs or where a vehicle starts.
struct VisitedPlace {
  Vec2 place_enu_m;
  double reach_m = 0.0;  // as a leg has it
  ConfigPlace place;
  std::string key = "mission";
};

/// Rules that the seabed must keep.
struct CorridorRules {
  double half_swath_rad = 1.134;  // the corridor reaches tan(half_swath) times the depth to either side
  bool refuse_holes = true;       // else holes do not matter
  bool refuse_beyond = true;      // else a leg may leave the terrain
  double least_altitude_m = 0.0;  // obstacle floor of a vehicle that dives; 0: none
  double lowest_water_m = 0.0;    // above chart datum, while the mission may be there
};

/// Throws ConfigError, one problem per key and place at most, if a leg leaves the terrain, runs over land (above the
/// lowest water) or through the seabed, if all of a surveyed one is too shallow for the obstacle floor or for the
/// altitude to follow, or, with refuse_holes, if a place of its corridor inside the terrain has no height. A leg is
/// examined in steps of the posts, but at most 2000, and the seabed as posts that far apart show it. Returns the least
/// depth below chart datum that was examined along surveyed legs; without any, of the whole terrain. At least 0.
double check_corridors(const TerrainSource& terrain, const std::vector<Leg>& legs, const CorridorRules& rules);

/// The same for places, without corridors.
void check_places(const TerrainSource& terrain, const std::vector<VisitedPlace>& places, const CorridorRules& rules);

}  // namespace ensonify::pager

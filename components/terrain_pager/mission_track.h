#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/config/config_error.h"
#include "components/runtime/sim_time.h"
#include "components/terrain/terrain_source.h"
#include "components/terrain_pager/config.h"
#include "kernels/vehicle/runlines/runline.h"
#include "kernels/vehicle/vertical/tide.h"

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

/// All of a scenario's mission that is known before it is run, as the seabed and its meshes are held against it:
/// lines with their run-ins and run-outs, orbits, the whole rectangle of an adaptive survey; places, starts, and where
/// the vehicle is when it is sent to another depth. Not the turns between lines. A mission that begins its second round
/// at another depth than the first has its second round as well.
struct MissionTrack {
  std::vector<Leg> legs;
  std::vector<VisitedPlace> places;
  double lowest_water_m = 0.0;  // above chart datum
};

/// Reaches count to the lowest head of a vehicle; of several, to that of the vehicle whose heads reach least far down,
/// for nothing says which of them is steered.
MissionTrack track_of(const TerrainPagerConfig& config);

/// The lowest water above chart datum while a run of this length lasts; of one without an end, in its first 30 days,
/// which have two spring tides. Sampled every five minutes: within 3 mm for a semidiurnal tide of 10 m amplitude.
double lowest_water_m(const vertical::Tide& tide, std::optional<SimTime> duration);

/// Places in a scenario's file of what is run, for messages. What the launch file has changed stands nowhere there, and
/// has the file alone.
struct MissionPlaces {
  ConfigPlace mission;
  std::vector<ConfigPlace> steps;             // of each; lines laid out by a rule have that of the rule, once
  std::map<std::string, ConfigPlace> starts;  // by vehicle

  const ConfigPlace& step(std::size_t i) const;
  const ConfigPlace& start(const std::string& vehicle) const;
};

/// Reads `scenario_file` again, if it is there and `scenario_text`, the scenario in force in its canonical form, is
/// not empty.
MissionPlaces mission_places(const std::string& scenario_file, const std::string& scenario_text);

/// Part of a mission that may be beyond the terrain: nothing where tiles of it are needed, else all.
enum class Beyond { kRefused, kAllowed };

/// Holds the scenario's mission and its vehicles' starts against the seabed (check_corridors, check_places) and returns
/// the least depth along the runlines. Throws ConfigError with the place of what cannot be run.
double check_mission(const source::TerrainSource& terrain, const TerrainPagerConfig& config, Beyond beyond);

/// The same, and against meshes, for a launch in which no pager runs: opens the seabed that the scenario names. What
/// such a launch runs may be beyond it.
void check_mission_alone(const TerrainPagerConfig& config);

}  // namespace ensonify::pager

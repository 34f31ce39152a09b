#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/config/config_error.h"
#include "components/runtime/sim_time.h"
#include "components/terrain/terrain_source.h"
#include "components/terrain_pager/config.h"
#include "components/terrain_pager/corridors.h"
#include "kernels/mesh/progressive/hierarchy.h"
#include "kernels/vehicle/runlines/runline.h"
#include "kernels/vehicle/vertical/tide.h"

namespace ensonify::pager {

/// All of a scenario's mission that is known before it is run, as the seabed and its meshes are held against it:
/// lines with their run-ins and run-outs, a recorded track, orbits, the whole rectangle of an adaptive survey; places,
/// starts, and where the vehicle is when it is sent to another depth. Not the turns between lines. A mission that
/// begins its second round at another depth than the first has its second round as well.
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

/// Where the mission begins, as far as it is known; nothing: it has neither line nor track.
std::optional<Vec2> first_place(const TerrainPagerConfig& config);

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

/// A leg may lie beside a thing, or above it where the vehicle dives; not through it, nor below. Throws ConfigError
/// with the place of the first that does not; `what` is the thing in messages.
void check_legs(const MissionTrack& track, const std::string& what, const progressive::TriangleMesh& mesh);

/// The same, and against meshes and objects, for a launch in which no pager runs: opens the seabed that the scenario
/// names. What such a launch runs may be beyond it.
void check_mission_alone(const TerrainPagerConfig& config);

}  // namespace ensonify::pager

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/runtime/sim_time.h"
#include "components/terrain_pager/config.h"
#include "components/terrain_pager/corridor.h"
#include "kernels/vehicle/vertical/tide.h"

namespace ensonify::pager {

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

}  // namespace ensonify::pager

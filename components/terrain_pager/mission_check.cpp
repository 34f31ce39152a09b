#include "components/terrain_pager/mission_check.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <variant>
#include <vector>

#include "components/runtime/terrain/source_of.h"
#include "components/terrain_pager/corridor.h"
#include "components/terrain_pager/meshes.h"
#include "components/terrain_pager/mission_places.h"

namespace ensonify::pager {
namespace {

/// Where vehicles start that are told a place.
std::vector<VisitedPlace> starts_of(const std::vector<Vehicle>& vehicles, const MissionPlaces& where) {
  std::vector<VisitedPlace> places;
  for (const Vehicle& vehicle : vehicles) {
    if (!vehicle.start) continue;
    const frames::Vec3& place = vehicle.start->position_enu_m;
    places.push_back({place.head<2>(), vehicle.floats ? 0.0 : -place.z(), where.start(vehicle.name),
                      "vehicles." + vehicle.name + ".start"});
  }
  return places;
}

/// What the mission visits besides lines: places, circles, the far edge of an adaptive survey, and the outer ends of
/// run-ins and run-outs as far as they lie on the terrain.
std::vector<VisitedPlace> places_of(const Mission& mission, const Extent& extent, const MissionPlaces& where) {
  std::vector<VisitedPlace> places;
  std::optional<double> depth_m = mission.altitude_m ? std::nullopt : std::optional(mission.depth_m);
  for (std::size_t i = 0; i < mission.steps.size(); ++i) {
    const MissionStep& step = mission.steps[i];
    const ConfigPlace& here = where.step(i);
    if (const auto* go = std::get_if<GoAt>(&step)) depth_m = depth_after(*go, depth_m);
    if (const auto* line = std::get_if<FlyLine>(&step)) {
      const auto& points = line->points_enu_m;
      const std::size_t last = points.size() - 1;
      const Vec2 before = navigation::extended({points[0], points[1]}, mission.run_in_m, 0.0).start_enu_m;
      const Vec2 behind = navigation::extended({points[last - 1], points[last]}, 0.0, mission.run_out_m).end_enu_m;
      if (extent.contains(before)) places.push_back({before, depth_m, here, "mission run-in"});
      if (extent.contains(behind)) places.push_back({behind, depth_m, here, "mission run-out"});
    }
    if (const auto* pass = std::get_if<PassPlace>(&step)) places.push_back({pass->place_enu_m, depth_m, here});
    const auto* keep = std::get_if<KeepPlace>(&step);
    if (keep != nullptr && keep->place_enu_m) places.push_back({*keep->place_enu_m, depth_m, here});
    if (const auto* orbit = std::get_if<FlyOrbit>(&step)) {
      for (int k = 0; k < 16; ++k) {
        const double bearing = std::numbers::pi / 8.0 * k;
        places.push_back(
            {orbit->centre_enu_m + orbit->radius_m * Vec2(std::sin(bearing), std::cos(bearing)), depth_m, here});
      }
    }
  }
  if (mission.adaptive) {
    AdaptivePlan last = *mission.adaptive;
    last.first_line_m = last.width_m;
    places.push_back({first_line(last).start_enu_m, depth_m, where.step(0)});
    places.push_back({first_line(last).end_enu_m, depth_m, where.step(0)});
  }
  return places;
}

}  // namespace

double check_mission(const source::TerrainSource& terrain, const TerrainPagerConfig& config, Beyond beyond) {
  const auto holes = config.terrain.seabed.kind == Seabed::Kind::kRaster ? config.terrain.seabed.raster.holes
                                                                         : RasterSeabed::Holes::kKeep;
  const MissionPlaces places = mission_places(config.scenario_file, config.scenario_text);
  CorridorRules rules;
  rules.half_swath_rad = config.corridor_half_deg * std::numbers::pi / 180.0;
  rules.refuse_holes = beyond == Beyond::kRefused && holes == RasterSeabed::Holes::kRefuse;
  rules.refuse_beyond = beyond == Beyond::kRefused;
  rules.depth_m = config.mission.runline_depths_m();
  rules.place = places.runlines(config.mission);
  rules.least_altitude_m = config.mission.least_altitude_m;
  const double shallowest_m = check_corridors(terrain, config.mission.runlines, rules, places.mission);
  check_places(terrain, places_of(config.mission, terrain.extent(), places), rules.refuse_beyond);
  check_places(terrain, starts_of(config.vehicles, places), rules.refuse_beyond);
  return shallowest_m;
}

void check_mission_alone(const TerrainPagerConfig& config) {
  const auto terrain = source::source_of(config.terrain);
  const Meshes meshes(config, *terrain);
  check_mission(*terrain, config, Beyond::kAllowed);
}

}  // namespace ensonify::pager

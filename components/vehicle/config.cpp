#include "components/vehicle/config.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/config/read_parameters.h"
#include "components/errors/exit_error.h"
#include "components/tracks/followed_track.h"
#include "scenarios/world/world.h"

namespace ensonify {

namespace {

/// Holds a mission against what a vehicle's forces can do. With several vehicles the one that is steered is not known
/// here; it is taken to be the one without a start of its own.
void check_abilities(ConfigReader& from, const World& world, const Vehicle& vehicle, const HydrodynamicVehicle& moved) {
  if (vehicle.start && world.vehicles.size() > 1) return;
  double fastest_mps = world.mission.speed_mps;
  for (const MissionStep& step : world.mission.steps) {
    if (const auto* go = std::get_if<GoAt>(&step)) fastest_mps = std::max(fastest_mps, go->speed_mps.value_or(0.0));
  }
  const motion::Body body(moved.body);
  const double top_mps = motion::top_speed_mps(body);
  if (fastest_mps > top_mps) {
    from.problem("", fmt::format("the mission asks for {} m/s, more than {}'s propellers make; allowed: {:.2f} m/s",
                                 fastest_mps, vehicle.name, std::floor(100.0 * top_mps) / 100.0));
    return;
  }
  const double planned_m = motion::turning_circle_m(fastest_mps, vehicle.limits);
  const double tightest_m = motion::tightest_circle_m(moved.helm, body, fastest_mps);
  if (planned_m < tightest_m) {
    from.problem("", fmt::format("the scenario has {} turn on {} m at {} m/s, tighter than its forces make; allowed: "
                                 "turning_radius_m {:.1f} or more",
                                 vehicle.name, planned_m, fastest_mps, std::ceil(10.0 * tightest_m) / 10.0));
  }
}

}  // namespace

void VehicleConfig::follow(ConfigReader& from, const World& world) {
  const FollowTrack& wanted = *world.mission.follow;
  if (!steered_by.empty()) from.problem("steered_by", "stands beside a mission that follows a track: nobody steers");
  try {
    const auto origin = world.site.origin_from_raster ? std::nullopt : std::optional(world.site.origin);
    followed = std::make_shared<const tracks::FollowedTrack>(tracks::followed_track(wanted, origin, fastest_mps));
  } catch (const ConfigError& error) {
    return from.add(error);
  } catch (const UserError& error) {
    ConfigProblem problem = wanted.here;
    problem.message = error.what();
    return from.add(ConfigError({problem}));
  }
  const frames::MovingPose begin = followed->at(0.0);
  start = motion::State{begin.pose.position_enu_m, 0.0, begin.velocity_enu_mps.head<2>().norm()};
}

VehicleConfig VehicleConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  VehicleConfig config;
  read_parameters<VehicleParameters>(from, config);
  const Vehicle vehicle = own_vehicle(from, world, process, config.vehicle);
  config.limits = vehicle.limits;
  config.fastest_mps = vehicle.fastest_mps;
  config.waves = vehicle.waves;
  config.disturbance = vehicle.disturbance;
  config.seed = world.seed;
  config.name = vehicle.name;
  config.water = {world.vertical.tide, world.current, vehicle.floats};
  if (!vehicle.dynamics_file.empty()) {
    try {
      config.hydrodynamics = read_dynamics(vehicle.dynamics_file);
      check_abilities(from, world, vehicle, *config.hydrodynamics);
    } catch (const ConfigError& error) {
      from.add(error);
    }
  }
  for (const PilotKeys& pilot : config.steered_by) {
    if (pilot.by == PilotKeys::By::kActuators && vehicle.dynamics_file.empty())
      from.problem("steered_by." + pilot.name + ".by",
                   "actuators are of a vehicle moved by forces; " + vehicle.name + " has no `dynamics` file");
  }
  config.start = vehicle.start;
  config.plan = MissionPlan::of(world, vehicle);
  const Vehicle* follows = follower(world);
  if (follows != nullptr && follows->name == vehicle.name) {
    config.follow(from, world);
    return config;
  }
  if (!config.start && !config.plan.needs_chart()) {
    if (world.mission.runlines.empty()) {
      from.problem("", "the scenario gives vehicle " + vehicle.name + " neither a start nor a runline to start at");
    } else {
      config.start = start_of(config.plan, world.mission.runlines);
    }
  }
  return config;
}

}  // namespace ensonify

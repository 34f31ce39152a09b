#include "components/autopilot/config.h"

#include "components/config/read_parameters.h"
#include "scenarios/world/world.h"

namespace ensonify {

AutopilotConfig AutopilotConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  AutopilotConfig config;
  read_parameters<AutopilotParameters>(from, config);
  const Vehicle vehicle = own_vehicle(from, world, process, config.vehicle);
  config.plan = MissionPlan::of(world, vehicle);
  if (vehicle.floats && world.mission.depth_m > 0.0) {
    from.problem("", "the mission's depth_m needs a vehicle that dives; " + vehicle.name + " floats");
  }
  if (const Vehicle* follows = follower(world); follows != nullptr) {
    from.problem("", "the scenario's mission follows a recorded track, which " + follows->name +
                         " goes along by itself: there is nothing to steer; allowed: a launch without this process");
    return config;
  }
  if (!config.plan.needs_chart() && world.mission.steps.empty()) {
    from.problem("", "the scenario's mission has no step");
  }
  return config;
}

}  // namespace ensonify

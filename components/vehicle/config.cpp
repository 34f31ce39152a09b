#include "components/vehicle/config.h"

#include "components/runtime/config/config_reader.h"
#include "components/runtime/config/own_vehicle.h"

namespace ensonify {

VehicleConfig VehicleConfig::read(ConfigReader& from, const Scenario& scenario, const std::string& process) {
  VehicleConfig config;
  from.optional("pose_rate_hz", config.pose_rate_hz, 1, 1000);

  const Vehicle vehicle = own_vehicle(from, scenario, process);
  config.limits = vehicle.limits;
  config.fastest_mps = vehicle.fastest_mps;
  config.waves = vehicle.waves;
  config.disturbance = vehicle.disturbance;
  config.seed = scenario.seed;
  config.name = vehicle.name;
  config.water = {scenario.vertical.tide, scenario.current, vehicle.floats};
  if (!vehicle.dynamics_file.empty()) {
    try {
      config.hydrodynamics = read_dynamics(vehicle.dynamics_file);
    } catch (const ConfigError& error) {
      from.add(error);
    }
  }
  config.start = vehicle.start;
  config.plan = MissionPlan::of(scenario, vehicle);
  if (!config.start && !config.plan.needs_chart()) {
    if (scenario.mission.runlines.empty()) {
      from.problem("", "the scenario tells vehicle " + vehicle.name + " neither a start nor a runline to start at");
    } else {
      config.start = start_of(config.plan, scenario.mission.runlines);
    }
  }
  return config;
}

}  // namespace ensonify

#include "components/autopilot/config.h"

#include "components/config/config_reader.h"
#include "scenarios/world/own_vehicle.h"

namespace ensonify {

AutopilotConfig AutopilotConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  AutopilotConfig config;
  from.optional("command_rate_hz", config.command_rate_hz, 1, 100);
  from.optional("lookahead_radii", config.lookahead_radii, 0.2, 20);
  from.optional("turn_margin", config.turn_margin, 1, 10);
  from.optional("turn_speed_fraction", config.turn_speed_fraction, 0.1, 1);
  from.optional("drift_settle_s", config.drift_settle_s, 0, 1000);
  from.optional("patience_s", config.patience_s, 0, 1e6);
  const Vehicle vehicle = own_vehicle(from, world, process);
  config.plan = MissionPlan::of(world, vehicle);
  if (vehicle.floats && world.mission.depth_m > 0.0) {
    from.problem("", "the mission's depth_m needs a vehicle that dives; " + vehicle.name + " floats");
  }
  if (!config.plan.needs_chart() && world.mission.steps.empty()) {
    from.problem("", "the scenario's mission has no step");
  }
  return config;
}

}  // namespace ensonify

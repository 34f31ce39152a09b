#include "components/autopilot/config.h"

#include "components/runtime/config/config_reader.h"
#include "components/runtime/config/own_vehicle.h"

namespace ensonify {

AutopilotConfig AutopilotConfig::read(ConfigReader& from, const Scenario& scenario, const std::string& process) {
  AutopilotConfig config;
  from.optional("command_rate_hz", config.command_rate_hz, 1, 100);
  from.optional("lookahead_radii", config.lookahead_radii, 0.2, 20);
  from.optional("turn_margin", config.turn_margin, 1, 10);
  from.optional("turn_speed_fraction", config.turn_speed_fraction, 0.1, 1);
  from.optional("drift_settle_s", config.drift_settle_s, 0, 1000);
  from.optional("patience_s", config.patience_s, 0, 1e6);
  const Vehicle vehicle = own_vehicle(from, scenario, process);
  config.plan = MissionPlan::of(scenario, vehicle);
  if (vehicle.floats && scenario.mission.depth_m > 0.0) {
    from.problem("", "the mission's depth_m needs a vehicle that dives; " + vehicle.name + " floats");
  }
  if (!config.plan.needs_chart() && scenario.mission.steps.empty()) {
    from.problem("", "the scenario's mission has no step");
  }
  return config;
}

}  // namespace ensonify

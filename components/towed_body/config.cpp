#include "components/towed_body/config.h"

#include "components/config/read_parameters.h"
#include "scenarios/world/world.h"

namespace ensonify {
TowedBodyConfig TowedBodyConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  TowedBodyConfig config;
  read_parameters<TowedBodyParameters>(from, config);
  const Vehicle vehicle = own_vehicle(from, world, process, config.vehicle);
  config.process = process;
  config.name = vehicle.name;
  config.seed = world.seed;
  config.disturbance = vehicle.disturbance;
  config.current = world.current;
  return config;
}

}  // namespace ensonify

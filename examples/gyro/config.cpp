#include "examples/gyro/config.h"

#include "components/config/read_parameters.h"
#include "scenarios/world/world.h"

namespace ensonify {

GyroConfig GyroConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  GyroConfig config;
  read_parameters<GyroParameters>(from, config);
  config.seed = world.seed;
  config.process = process;
  return config;
}

}  // namespace ensonify

#include "examples/gyro/config.h"

#include "components/config/read_parameters.h"

namespace ensonify {

GyroConfig GyroConfig::read(ConfigReader& from, const ScenarioHeader& scenario, const std::string& process) {
  GyroConfig config;
  read_parameters<GyroParameters>(from, config);
  config.seed = scenario.seed;
  config.process = process;
  return config;
}

}  // namespace ensonify

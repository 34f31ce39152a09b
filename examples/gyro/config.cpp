#include "examples/gyro/config.h"

#include "components/runtime/config/config_reader.h"
#include "components/runtime/config/scenario.h"

namespace ensonify {

GyroConfig GyroConfig::read(ConfigReader& from, const Scenario& scenario, const std::string& process) {
  GyroConfig config;
  from.optional("rate_hz", config.rate_hz, 1, 1000);
  from.optional("bias_deg", config.bias_rad, -180, 180, kDegrees);
  from.optional("sigma_deg", config.sigma_rad, 0, 90, kDegrees);
  config.seed = scenario.seed;
  config.process = process;
  return config;
}

}  // namespace ensonify

#include "examples/gyro/config.h"

#include "components/config/config_reader.h"
#include "scenarios/world/world.h"

namespace ensonify {

GyroConfig GyroConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  GyroConfig config;
  from.optional("rate_hz", config.rate_hz, 1, 1000);
  from.optional("bias_deg", config.bias_rad, -180, 180, kDegrees);
  from.optional("sigma_deg", config.sigma_rad, 0, 90, kDegrees);
  config.seed = world.seed;
  config.process = process;
  return config;
}

}  // namespace ensonify

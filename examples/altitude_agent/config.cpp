#include "examples/altitude_agent/config.h"

#include "components/config/read_parameters.h"

namespace ensonify {

AltitudeAgentConfig AltitudeAgentConfig::read(ConfigReader& from, const ScenarioHeader&, const std::string&) {
  AltitudeAgentConfig config;
  read_parameters<AltitudeAgentParameters>(from, config);
  return config;
}

}  // namespace ensonify

#include "components/coverage/config.h"

#include "components/runtime/config/config_reader.h"

namespace ensonify {

CoverageConfig CoverageConfig::read(ConfigReader& from, const Scenario& scenario, const std::string&) {
  CoverageConfig config;
  from.optional("rate_hz", config.rate_hz, 1, 10);
  from.optional("head_depth_m", config.head_depth_m, -10, 11000);
  if (scenario.mission.adaptive) {
    config.plan = *scenario.mission.adaptive;
  } else {
    from.problem("", "needs a mission that is adaptive: it says which rectangle is to be covered");
  }
  return config;
}

}  // namespace ensonify

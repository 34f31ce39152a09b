#include "components/nav_feed/config.h"

#include "components/runtime/config/config_reader.h"
#include "components/runtime/config/own_vehicle.h"

namespace ensonify {

NavFeedConfig NavFeedConfig::read(ConfigReader& from, const Scenario& scenario, const std::string& process) {
  NavFeedConfig config;
  from.optional("port", config.port, 1024, 65535);
  from.optional("pose_rate_hz", config.pose_rate_hz, 1, 1000);
  from.optional("delay_s", config.delay_s, 0, 60);
  from.optional("fastest_mps", config.fastest_mps, 0.1, 1000);
  config.floats = own_vehicle(from, scenario, process).floats;
  if (!scenario.site.origin_from_raster) config.origin = scenario.site.origin;
  config.tide = scenario.vertical.tide;
  config.current = scenario.current;
  return config;
}

}  // namespace ensonify

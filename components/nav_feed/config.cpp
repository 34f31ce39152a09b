#include "components/nav_feed/config.h"

#include "components/config/read_parameters.h"
#include "scenarios/world/world.h"

namespace ensonify {

NavFeedConfig NavFeedConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  NavFeedConfig config;
  read_parameters<NavFeedParameters>(from, config);
  config.floats = own_vehicle(from, world, process, config.vehicle).floats;
  if (!world.site.origin_from_raster) config.origin = world.site.origin;
  config.tide = world.vertical.tide;
  config.datums = world.vertical.datums;
  config.current = world.current;
  return config;
}

}  // namespace ensonify

#include "components/nav_feed/config.h"

#include "components/config/config_reader.h"
#include "scenarios/world/own_vehicle.h"

namespace ensonify {

NavFeedConfig NavFeedConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  NavFeedConfig config;
  from.optional("port", config.port, 1024, 65535);
  from.optional("pose_rate_hz", config.pose_rate_hz, 1, 1000);
  from.optional("delay_s", config.delay_s, 0, 60);
  from.optional("fastest_mps", config.fastest_mps, 0.1, 1000);
  std::array<double, 3> antenna{};
  from.optional("antenna_position_m", antenna, -500, 500);
  config.antenna_body_m = {antenna[0], antenna[1], antenna[2]};
  from.optional_choice("height", config.height,
                       {{"water", NavFeedConfig::Height::kWater}, {"gga", NavFeedConfig::Height::kGga}});
  config.floats = own_vehicle(from, world, process).floats;
  if (!world.site.origin_from_raster) config.origin = world.site.origin;
  config.tide = world.vertical.tide;
  config.datums = world.vertical.datums;
  config.current = world.current;
  return config;
}

}  // namespace ensonify

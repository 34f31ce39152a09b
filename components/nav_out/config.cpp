#include "components/nav_out/config.h"

#include "components/config/read_parameters.h"

namespace ensonify {

NavOutConfig NavOutConfig::read(ConfigReader& from, const World& world, const std::string& /*process*/) {
  NavOutConfig config;
  read_parameters<NavOutParameters>(from, config);
  if (config.outputs.empty()) from.problem("outputs", "names none; needs one at least");
  config.start_unix_ns = world.start_unix_ns;
  if (!world.site.origin_from_raster) config.origin = world.site.origin;
  return config;
}

}  // namespace ensonify

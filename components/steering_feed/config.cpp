#include "components/steering_feed/config.h"

#include "components/config/read_parameters.h"

namespace ensonify {

void SteeringFeedParameters::check(const ConfigReader& from) const {
  if (sources.empty()) from.problem("sources", "names none; allowed: one or more");
}

SteeringFeedConfig SteeringFeedConfig::read(ConfigReader& from, const World& world, const std::string&) {
  SteeringFeedConfig config;
  read_parameters<SteeringFeedParameters>(from, config);
  if (!world.site.origin_from_raster) config.origin = world.site.origin;
  return config;
}

}  // namespace ensonify

#include "components/nav_feed/config.h"

#include "components/config/read_parameters.h"
#include "scenarios/world/world.h"

namespace ensonify {

void FeedSource::check(const ConfigReader& from) const {
  ByteSource::check(from);
  if (std::holds_alternative<File>(way) && format != Format::kNmea) {
    from.problem("format", "a file is played by the times of its sentences; needs format: nmea");
  }
  if (std::holds_alternative<File>(way) && time_scale == TimeScale::kNone) {
    from.problem("time_scale", "a file is played by the times of its sentences; needs utc or gps");
  }
}

void NavFeedParameters::check(const ConfigReader& from) const {
  const FeedSource* first = nullptr;
  for (const FeedSource& source : sources) {
    if (!source.may_give_places()) continue;
    if (first != nullptr) {
      from.problem("sources." + source.name + ".place",
                   "places come from " + first->name + " already; one of them needs place: false");
    }
    first = &source;
  }
  if (first == nullptr)
    from.problem("sources", "none gives places; needs one with place: true and format nmea or km_binary");
}

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

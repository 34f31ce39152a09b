#include "components/nav_feed/config.h"

#include "components/config/read_parameters.h"
#include "components/errors/exit_error.h"
#include "components/transport/address.h"
#include "scenarios/world/world.h"

namespace ensonify {

namespace {

/// Addresses of a source, and whether anybody may send to it.
void check_addresses(const FeedSource& source, const ConfigReader& from) {
  const auto read = [&](const char* key, const auto& parse) -> std::optional<Address> {
    try {
      return parse();
    } catch (const UserError& error) {
      from.problem(key, error.what());
      return std::nullopt;
    }
  };
  if (const auto* client = std::get_if<FeedSource::TcpClient>(&source.way))
    read("of", [&] { return receiver_address(client->address, client->port); });
  const auto at = read("at", [&] { return host_address(source.at); });
  bool any = false, all = true;
  for (const std::string& sender : source.senders) {
    const auto found = read("senders", [&] { return host_address(sender); });
    any = any || (at && found && found->family == at->family);
    all = all && found;
  }
  const bool receives =
      std::holds_alternative<FeedSource::Udp>(source.way) || std::holds_alternative<FeedSource::TcpServer>(source.way);
  if (!receives || !at || !all || any) return;
  from.problem("senders",
               std::string("none may send to ") + host_of(*at) + "; allowed: at least one " +
                   (at->family == Address::Family::kIpv6 ? "IPv6 address as ::1" : "IPv4 address as 127.0.0.1"));
}

}  // namespace

void FeedSource::check(const ConfigReader& from) const {
  check_addresses(*this, from);
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

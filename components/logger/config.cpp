#include "components/logger/config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "components/config/read_parameters.h"
#include "components/errors/exit_error.h"
#include "components/sonar/environment.h"
#include "components/transport/address.h"

namespace ensonify {

namespace {

constexpr double kDeepestReference_m = 10.0;  // of a vessel at the surface

constexpr const char *kAll = "all", *kKmall = "kmall", *kWcd = "wcd", *kKmwcd = "kmwcd", *kXtf = "xtf";
const std::vector<std::string> kFormats{kAll, kKmall, kWcd, kKmwcd, kXtf};
const std::vector<std::string> kSentFormats{kAll, kKmall, kWcd, kKmwcd};

void read_formats(ConfigReader& from, const char* key, const std::vector<std::string>& allowed, FormatList& formats) {
  if (from.node(key) == nullptr) return;
  std::vector<std::string> given;
  from.required(key, given);
  formats.clear();
  for (const std::string& word : given) {
    if (std::find(allowed.begin(), allowed.end(), word) == allowed.end())
      from.problem(key, fmt::format("\"{}\" is no format; allowed: {}", word, fmt::join(allowed, ", ")));
    else if (!formats.has(word)) formats.push_back(word);
  }
  if (given.empty()) from.problem(key, fmt::format("names none; allowed: {}", fmt::join(allowed, ", ")));
}

std::string schema_of(const std::vector<std::string>& allowed) {
  return fmt::format(R"({{"type": "array", "minItems": 1, "items": {{"enum": ["{}"]}}}})",
                     fmt::join(allowed, R"(", ")"));
}

/// All heads that vehicles of the scenario carry.
std::vector<std::string> heads_of(const World& world) {
  std::vector<std::string> heads;
  for (const Vehicle& vehicle : world.vehicles) {
    for (const auto& mounting : vehicle.mountings) heads.push_back(mounting.first);
  }
  return heads;
}

/// These formats have no datagrams here for a vehicle's own depth.
bool dives(const Mission& mission) {
  return mission.depth_m > kDeepestReference_m || mission.altitude_m.has_value() ||
         std::any_of(mission.steps.begin(), mission.steps.end(), [](const MissionStep& step) {
           const auto* go = std::get_if<GoAt>(&step);
           return go != nullptr && (go->depth_m || go->altitude_m);
         });
}

}  // namespace

ConfigNode FormatList::in_file() const {
  ConfigNode list;
  list.kind = ConfigNode::Kind::kList;
  for (const std::string& word : *this) list.items.push_back(ConfigNode::text(word));
  return list;
}

bool FormatList::has(const std::string& format) const { return std::find(begin(), end(), format) != end(); }

void LoggedFormats::read(ConfigReader& from, const char* key) { read_formats(from, key, kFormats, *this); }
std::string LoggedFormats::schema() { return schema_of(kFormats); }

void SentFormats::read(ConfigReader& from, const char* key) { read_formats(from, key, kSentFormats, *this); }
std::string SentFormats::schema() { return schema_of(kSentFormats); }

void ReceiverParameters::check(const ConfigReader& from) const {
  const auto check = [&](const char* key, auto&& parse) {
    try {
      parse();
    } catch (const UserError& error) {
      from.problem(key, error.what());
    }
  };
  if (!to.empty()) check("to", [&] { udp_address(to); });
  check("interface", [&] { interface_address(interface); });
}

namespace {

/// The vehicle with a head, as files state it.
logger::Vessel vessel_of(const ConfigReader& from, const char* key, const std::string& head, const World& world) {
  logger::Vessel vessel;
  const auto mounting = world.mounting(head);
  if (!mounting) {
    const std::vector<std::string> heads = heads_of(world);
    const std::string carried = heads.empty() ? "none" : fmt::format("{}", fmt::join(heads, ", "));
    if (head.empty() && heads.size() > 1)
      from.problem(key, fmt::format("is to be named where vehicles carry several; the scenario's carry: {}", carried));
    else from.problem(key, fmt::format("\"{}\" is no head of the scenario; its vehicles carry: {}", head, carried));
    return vessel;
  }
  const Vehicle& vehicle = world.vehicle(mounting->first);
  vessel.head = mounting->second.measured;
  vessel.dives = !vehicle.floats && dives(world.mission);
  vessel.water_line_m = vehicle.floats ? -vehicle.floats->change_m : -world.mission.depth_m;
  return vessel;
}

void check_formats_without_multibeam(const ConfigReader& from, const LoggedFormats& formats) {
  for (const std::string& format : formats) {
    if (format != kXtf)
      from.problem("formats", fmt::format("{}: needs the soundings of a multibeam: head is not given", format));
  }
}

/// Streams carry what files get.
void check_receivers(const ConfigReader& from, const LoggerConfig& config) {
  for (std::size_t i = 0; i < config.send.size(); ++i) {
    const ReceiverParameters& receiver = config.send[i];
    const std::string key = fmt::format("send[{}]", i);
    for (const std::string& format : receiver.formats) {
      if (!config.formats.has(format))
        from.problem(key + ".formats",
                     fmt::format("{} is sent as it is logged, and formats does not name it; it names: "
                                 "{}",
                                 format, fmt::join(config.formats, ", ")));
    }
    if (!from.good()) continue;
    const auto same = [&](const ReceiverParameters& other) {
      return udp_address(other.to) == udp_address(receiver.to);
    };
    if (std::any_of(config.send.begin(), config.send.begin() + static_cast<std::ptrdiff_t>(i), same))
      from.problem(key + ".to", fmt::format("{} is a receiver already; give it all its formats there", receiver.to));
  }
}

}  // namespace

bool LoggerConfig::water_column() const { return formats.has(kWcd) || formats.has(kKmwcd); }

LoggerConfig LoggerConfig::read(ConfigReader& from, const World& world, const std::string& /*process*/) {
  LoggerConfig config;
  read_parameters<LoggerParameters>(from, config);
  config.start_unix_ns = world.start_unix_ns;
  config.profile = applied_profile(world);
  if (!world.site.origin_from_raster) config.origin = world.site.origin;

  if (config.head.empty() && config.sidescan.empty() && heads_of(world).size() == 1)
    config.head = heads_of(world).front();
  if (config.head.empty() && !config.sidescan.empty()) check_formats_without_multibeam(from, config.formats);
  else config.vessel = vessel_of(from, "head", config.head, world);
  if (!config.sidescan.empty()) {
    config.sidescan_vessel = vessel_of(from, "sidescan", config.sidescan, world);
    if (!config.formats.has(kXtf)) from.problem("sidescan", "is written in xtf alone, which formats does not name");
  }
  const auto mounting = world.mounting(config.head.empty() ? config.sidescan : config.head);
  if (config.ship.empty() && mounting) config.ship = world.vehicle(mounting->first).name;
  for (const char* format : {kAll, kKmall, kWcd, kKmwcd}) {
    if (!config.formats.has(format) || !config.vessel.dives) continue;
    from.problem("formats",
                 fmt::format("{}: the vehicle {} dives, and depths of vehicles are not written yet; allowed: one that "
                             "floats, or a mission at one depth of {} m at most",
                             format, mounting ? mounting->first : std::string(), kDeepestReference_m));
  }
  check_receivers(from, config);
  return config;
}

}  // namespace ensonify

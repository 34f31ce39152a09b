#include "components/logger/config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "components/config/read_parameters.h"
#include "components/sonar/environment.h"

namespace ensonify {

namespace {

constexpr double kDeepestReference_m = 10.0;  // of a vessel at the surface

const std::vector<std::string> kFormats{"all"};

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

void LoggedFormats::read(ConfigReader& from, const char* key) {
  if (from.node(key) == nullptr) return;
  std::vector<std::string> given;
  from.required(key, given);
  clear();
  for (const std::string& word : given) {
    if (std::find(kFormats.begin(), kFormats.end(), word) == kFormats.end())
      from.problem(key, fmt::format("\"{}\" is no format; allowed: {}", word, fmt::join(kFormats, ", ")));
    else if (std::find(begin(), end(), word) == end())
      push_back(word);
  }
  if (given.empty()) from.problem(key, fmt::format("names none; allowed: {}", fmt::join(kFormats, ", ")));
}

ConfigNode LoggedFormats::in_file() const {
  ConfigNode list;
  list.kind = ConfigNode::Kind::kList;
  for (const std::string& word : *this) list.items.push_back(ConfigNode::text(word));
  return list;
}

std::string LoggedFormats::schema() {
  return fmt::format(R"({{"type": "array", "minItems": 1, "items": {{"enum": ["{}"]}}}})", fmt::join(kFormats, R"(", ")"));
}

LoggerConfig LoggerConfig::read(ConfigReader& from, const World& world, const std::string& /*process*/) {
  LoggerConfig config;
  read_parameters<LoggerParameters>(from, config);
  config.start_unix_ns = world.start_unix_ns;
  config.profile = applied_profile(world);
  if (!world.site.origin_from_raster) config.origin = world.site.origin;

  const std::vector<std::string> heads = heads_of(world);
  if (config.head.empty() && heads.size() == 1) config.head = heads.front();
  const auto mounting = world.mounting(config.head);
  if (!mounting) {
    from.problem("head", fmt::format("\"{}\" is no head of the scenario; its vehicles carry: {}", config.head,
                                     heads.empty() ? "none" : fmt::format("{}", fmt::join(heads, ", "))));
    return config;
  }
  const Vehicle& vehicle = world.vehicle(mounting->first);
  if (config.ship.empty()) config.ship = vehicle.name;
  config.vessel.head = mounting->second.measured;
  if (vehicle.floats) {
    config.vessel.water_line_m = -vehicle.floats->change_m;
  } else {
    config.vessel.water_line_m = -world.mission.depth_m;
    if (dives(world.mission)) {
      from.problem("",
                   fmt::format("the vehicle {} dives, and depths of vehicles are not written yet; allowed: one that "
                               "floats, or a mission at one depth of {} m at most",
                               vehicle.name, kDeepestReference_m));
    }
  }
  return config;
}

}  // namespace ensonify

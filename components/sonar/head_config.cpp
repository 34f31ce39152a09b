#include "components/sonar/head_config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "components/config/config_reader.h"
#include "components/sonar/head_motion.h"

namespace ensonify {
namespace {

constexpr double kLeastLatency_s = 1e-3;

/// Names of the other heads on the vehicle that carries this one.
std::vector<std::string> neighbours(const World& world, const std::string& process) {
  std::vector<std::string> names;
  for (const Vehicle& vehicle : world.vehicles) {
    if (!vehicle.mountings.contains(process)) continue;
    for (const auto& mounting : vehicle.mountings) {
      if (mounting.first != process) names.push_back(mounting.first);
    }
  }
  return names;
}

constexpr double kWeakest_db = 40.0;  // below the highest source level, that can be set

}  // namespace

void place_other_heads(const ConfigReader& from, const World& world, const std::string& process,
                       double processing_latency_s, std::vector<OtherHead>& others) {
  const auto allowed = neighbours(world, process);
  for (OtherHead& other : others) {
    if (std::find(allowed.begin(), allowed.end(), other.process) == allowed.end()) {
      from.problem("interference." + other.process,
                   fmt::format("the vehicle of {} carries no other head of this name; it carries: {}", process,
                               allowed.empty() ? "none" : fmt::format("{}", fmt::join(allowed, ", "))));
      continue;
    }
    other.from_us_body_m = world.mounting(other.process)->second.actual.position_body_m -
                           world.mounting(process)->second.actual.position_body_m;
  }
  if (!others.empty() && processing_latency_s < kLeastLatency_s) {
    from.problem("interference",
                 fmt::format("with a processing_latency_s of {}, what others send has not arrived when a ping is "
                             "computed; at least {} is needed",
                             processing_latency_s, kLeastLatency_s));
  }
}

void Trigger::check(const ConfigReader& from) const {
  if (slot_s >= cycle_s) {
    from.problem("slot_s", fmt::format("{} s does not lie in the cycle of {} s", slot_s, cycle_s));
  }
}

void place_head(const ConfigReader& from, const World& world, const std::string& process, HeadConfig& config) {
  place_other_heads(from, world, process, config.processing_latency_s, config.interference);
  config.world = std::make_shared<const World>(world);
  config.process = process;
  config.mounting = read_mounting(from, world, process);
}

Allowed filter_windows() {
  using echo::Window;
  return one_of({{"none", Window::kNone},
                 {"hann", Window::kHann},
                 {"hamming", Window::kHamming},
                 {"blackman", Window::kBlackman}});
}

HeadSettings HeadConfig::start_at(double range_m, double source_level_db) const {
  HeadSettings start;
  start.range_m = range_m;
  start.source_level_db = source_level_db;
  start.gain_spreading_db = effects.tvg ? gain_spreading_db : 0.0;
  start.gain_absorption_dbpm = effects.tvg ? gain_absorption_dbpm : 0.0;
  start.gain_offset_db = gain_offset_db;
  start.ping_rate_hz = ping_rate_hz;
  return start;
}

SettingLimits HeadConfig::limits_up_to(double nearest_m, double range_m, double source_level_db) const {
  SettingLimits limits;
  limits["range_m"] = {{nearest_m, range_m}};
  limits["source_level_db"] = {{source_level_db - kWeakest_db, source_level_db}};
  if (effects.tvg) {
    limits["gain_spreading_db"] = {kSpreading_db};
    limits["gain_absorption_dbpm"] = {kAbsorption_dbpm};
  }
  limits["gain_offset_db"] = {kOffset_db};
  limits["ping_rate_hz"] = {{kSlowest_hz, ping_rate_hz}};
  return limits;
}

}  // namespace ensonify

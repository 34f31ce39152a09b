#include "components/sonar/other_heads.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "components/config/config_reader.h"

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

}  // namespace ensonify

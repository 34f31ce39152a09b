#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "components/config/read_parameters.h"
#include "kernels/vehicle/vertical/tide.h"
#include "scenarios/scenario_file.h"
#include "scenarios/world/motion_keys.h"

namespace ensonify {
namespace {

constexpr double kDegph_radps = kDegrees.si / 3600.0;

frames::Vec2 towards(const FlowKeys& flow) {
  return {flow.speed_mps * std::sin(flow.heading_rad), flow.speed_mps * std::cos(flow.heading_rad)};
}

/// Values of a list must rise from entry to entry; those that are not given are another problem.
template <class Entries, class Value>
void check_rising(const ConfigReader& from, const char* list, const char* key, const Entries& entries, Value value,
                  const char* message) {
  for (std::size_t i = 1; i < entries.size(); ++i) {
    if (value(entries[i]) <= value(entries[i - 1])) {
      from.problem(fmt::format("{}[{}].{}", list, i, key), message);
    }
  }
}

}  // namespace

void DisturbanceKeys::read_base(ConfigReader& from) {
  const ConfigNode* named = from.node("preset");
  if (named == nullptr) return;
  if (const auto published = motion::disturbance_preset(named->scalar)) *this = DisturbanceKeys(*published);
}

void DisturbanceKeys::check(const ConfigReader& from) const {
  if (!from.good()) return;
  try {
    motion::Disturbance(si(), random::Stream(0, ""));  // what no single value's range can say
  } catch (const std::invalid_argument& error) {
    from.problem("", error.what());
  }
}

void ConstituentKeys::check(const ConfigReader& from) const {
  if (!constituent.empty() && !vertical::constituent_speed_degph(constituent)) {
    from.problem("constituent", fmt::format("\"{}\" is no tidal constituent; allowed: {}", constituent,
                                            vertical::constituent_names()));
  }
  if (!reference_utc.empty() && !parse_utc_ns(reference_utc)) {
    from.problem("reference_utc", "\"" + reference_utc + "\" is not a UTC time such as 2025-06-01T12:00:00Z");
  }
}

double ConstituentKeys::speed_radps() const {
  return vertical::constituent_speed_degph(constituent).value_or(0.0) * kDegph_radps;
}

double ConstituentKeys::phase_at_start_rad(double start_unix_s) const {
  const auto reference_ns = parse_utc_ns(reference_utc);
  if (reference_utc.empty() || !reference_ns) return phase_rad;
  const double since_s = start_unix_s - static_cast<double>(*reference_ns) * 1e-9;
  return std::remainder(phase_rad - speed_radps() * since_s, 2.0 * M_PI);
}

void CurrentKeys::check(const ConfigReader& from) const {
  check_rising(
      from, "profile", "depth_m", profile, [](const auto& flow) { return flow.depth_m; },
      "is not below the depth before it; depths rise");
}

motion::Current CurrentKeys::current(double start_unix_s) const {
  motion::Current current;
  for (const FlowAtDepthKeys& flow : profile) current.profile.push_back({flow.depth_m, towards(flow)});
  for (const StreamKeys& keys : streams) {
    motion::Current::Stream& stream = current.streams.emplace_back();
    stream.speed_radps = keys.speed_radps();
    stream.amplitude_enu_mps = towards(keys.flow);
    stream.phase_rad = keys.phase_at_start_rad(start_unix_s);
  }
  return current;
}

void LoadingKeys::check(const ConfigReader& from) const {
  check_rising(
      from, "settlement", "speed_mps", settlement, [](const auto& sinkage) { return sinkage.speed_mps; },
      "is not above the speed before it; speeds rise");
}

vertical::Loading LoadingKeys::loading() const {
  vertical::Loading loading;
  loading.settlement.assign(settlement.begin(), settlement.end());
  loading.change_m = deeper_m;
  loading.rate_mps = per_hour_m / 3600.0;
  return loading;
}

}  // namespace ensonify

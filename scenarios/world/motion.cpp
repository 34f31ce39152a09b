#include "scenarios/world/motion.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "components/config/config_reader.h"
#include "kernels/vehicle/motion/disturbance_presets.h"
#include "kernels/vehicle/vertical/tide.h"
#include "scenarios/world/sections.h"
#include "scenarios/world/world.h"

namespace ensonify {
namespace {

constexpr double kDegph_radps = kDegrees.si / 3600.0;

void read_axis(ConfigReader& from, const char* key, const std::string& unit, motion::AxisDisturbance& axis) {
  auto section = from.optional_section(key);
  if (!section) return;
  const FileUnit si = unit == "deg" ? kDegrees : kSi;
  const double most = unit == "deg" ? 60.0 : 20.0;
  section->optional("oscillation_" + unit, axis.oscillation_sd, 0, most, si);
  section->optional("period_s", axis.period_s, 0.2, 200);
  section->optional("jitter", axis.jitter, 0.02, 0.5);
  section->optional("coherence", axis.coherence, 0, 1);
  section->optional("lead_deg", axis.lead_rad, -360, 360, kDegrees);
  section->optional("wander_" + unit, axis.wander_sd, 0, most, si);
  section->optional("hurst", axis.hurst, 0.01, 0.99);
  section->optional("return_s", axis.return_s, 0.1, 1e6);
}

frames::Vec2 towards(double speed, double heading_rad) {
  return {speed * std::sin(heading_rad), speed * std::cos(heading_rad)};
}

}  // namespace

motion::DisturbanceParameters read_disturbance(ConfigReader from) {
  motion::DisturbanceParameters p;
  ConfigReader::Choices<std::string_view> presets;
  for (const std::string_view name : motion::kDisturbancePresets) presets.emplace_back(std::string(name), name);
  std::string_view preset;
  from.optional_choice("preset", preset, presets);
  if (!preset.empty()) p = *motion::disturbance_preset(preset);

  from.optional("highest_hz", p.highest_hz, 0.01, 50);
  read_axis(from, "surge", "m", p.surge);
  read_axis(from, "sway", "m", p.sway);
  read_axis(from, "heave", "m", p.heave);
  read_axis(from, "roll", "deg", p.roll);
  read_axis(from, "pitch", "deg", p.pitch);
  read_axis(from, "heading", "deg", p.heading);
  if (!from.good()) return {};
  try {
    motion::Disturbance(p, random::Stream(0, ""));  // what no single value's range can say
  } catch (const std::invalid_argument& error) {
    from.problem("", error.what());
  }
  return p;
}

double read_constituent_radps(ConfigReader& from) {
  std::string name;
  from.required("constituent", name);
  const auto speed = vertical::constituent_speed_degph(name);
  if (!speed && !name.empty()) {
    from.problem("constituent",
                 fmt::format("\"{}\" is no tidal constituent; allowed: {}", name, vertical::constituent_names()));
  }
  return speed.value_or(0.0) * kDegph_radps;
}

double phase_at_start_rad(ConfigReader& from, double phase_rad, double speed_radps, double start_unix_s) {
  std::string utc;
  from.optional("reference_utc", utc);
  if (utc.empty()) return phase_rad;
  const auto reference_ns = parse_utc_ns(utc);
  if (!reference_ns) {
    from.problem("reference_utc", "\"" + utc + "\" is not a UTC time such as 2025-06-01T12:00:00Z");
    return phase_rad;
  }
  const double since_s = start_unix_s - static_cast<double>(*reference_ns) * 1e-9;
  return std::remainder(phase_rad - speed_radps * since_s, 2.0 * M_PI);
}

motion::Current read_current(ConfigReader from, double start_unix_s) {
  motion::Current current;
  for (auto& item : from.list("profile")) {
    double speed_mps = 0.0, heading_rad = 0.0;
    motion::Current::Knot knot;
    item.required("depth_m", knot.depth_m, 0, 12000);
    item.required("speed_mps", speed_mps, 0, 10);
    item.required("heading_deg", heading_rad, -360, 360, kDegrees);
    knot.velocity_enu_mps = towards(speed_mps, heading_rad);
    if (!current.profile.empty() && knot.depth_m <= current.profile.back().depth_m) {
      item.problem("depth_m", "is not below the depth before it; depths rise");
    }
    current.profile.push_back(knot);
  }
  for (auto& item : from.list("streams")) {
    double speed_mps = 0.0, heading_rad = 0.0, phase_rad = 0.0;
    motion::Current::Stream stream;
    stream.speed_radps = read_constituent_radps(item);
    item.required("speed_mps", speed_mps, 0, 10);
    item.required("heading_deg", heading_rad, -360, 360, kDegrees);
    item.optional("phase_deg", phase_rad, -360, 360, kDegrees);
    stream.amplitude_enu_mps = towards(speed_mps, heading_rad);
    stream.phase_rad = phase_at_start_rad(item, phase_rad, stream.speed_radps, start_unix_s);
    current.streams.push_back(stream);
  }
  return current;
}

vertical::Loading read_loading(ConfigReader from) {
  vertical::Loading loading;
  for (auto& item : from.list("settlement")) {
    vertical::Sinkage sinkage;
    item.required("speed_mps", sinkage.speed_mps, 0, 30);
    item.required("lower_m", sinkage.lower_m, -2, 5);
    if (!loading.settlement.empty() && sinkage.speed_mps <= loading.settlement.back().speed_mps) {
      item.problem("speed_mps", "is not above the speed before it; speeds rise");
    }
    loading.settlement.push_back(sinkage);
  }
  from.optional("deeper_m", loading.change_m, -10, 10);
  double per_hour_m = 0.0;
  from.optional("deeper_m_per_hour", per_hour_m, -1, 1);
  loading.rate_mps = per_hour_m / 3600.0;
  return loading;
}

}  // namespace ensonify

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "components/config/read_parameters.h"
#include "kernels/vehicle/motion/disturbance.h"
#include "kernels/vehicle/vertical/tide.h"
#include "scenarios/world/sections.h"

namespace ensonify {
namespace {

constexpr double kDegph_radps = kDegrees.si / 3600.0;

void axis_parameters(auto& axis, auto&& visit, const char* oscillation, const char* wander, const char* unit,
                     double most) {
  visit(oscillation, unit, in(0, most), "standard deviation of the oscillation", axis.oscillation_sd);
  visit("period_s", "s", in(0.2, 200), "of the oscillation's spectral peak", axis.period_s);
  visit("jitter", "", in(0.02, 0.5), "standard deviation of its frequency over the mean", axis.jitter);
  visit("coherence", "", in(0, 1), "of the oscillation with the common wave", axis.coherence);
  visit("lead_deg", "deg", in(-360, 360), "how far it is ahead of the common wave", axis.lead_rad);
  visit(wander, unit, in(0, most), "standard deviation of the fractional part", axis.wander_sd);
  visit("hurst", "", in(0.01, 0.99), "roughness of that part: near 0 rough, near 1 smooth", axis.hurst);
  visit("return_s", "s", in(0.1, 1e6), "time constant with which it is pulled back", axis.return_s);
}

struct Shift : motion::AxisDisturbance {
  static void parameters(auto& self, auto&& visit) {
    axis_parameters(self, visit, "oscillation_m", "wander_m", "m", 20.0);
  }
};
struct Turn : motion::AxisDisturbance {
  static void parameters(auto& self, auto&& visit) {
    axis_parameters(self, visit, "oscillation_deg", "wander_deg", "deg", 60.0);
  }
};

struct DisturbancePreset {
  std::string preset;

  static void parameters(auto& self, auto&& visit) {
    Allowed presets;
    for (const std::string_view name : motion::kDisturbancePresets)
      presets.words.emplace_back(std::string(name).c_str());
    visit("preset", "", computed(presets), "a published motion; what stands beside it differs", self.preset);
  }
};

struct DisturbanceInFile {
  double highest_hz;
  Shift surge, sway, heave;
  Turn roll, pitch, heading;

  explicit DisturbanceInFile(const motion::DisturbanceParameters& p = {})
      : highest_hz(p.highest_hz),
        surge{p.surge},
        sway{p.sway},
        heave{p.heave},
        roll{p.roll},
        pitch{p.pitch},
        heading{p.heading} {}
  motion::DisturbanceParameters si() const { return {surge, sway, heave, roll, pitch, heading, highest_hz}; }

  static void parameters(auto& self, auto&& visit) {
    visit("highest_hz", "Hz", in(0.01, 50), "nothing moves faster", self.highest_hz);
    visit("surge", "forward", self.surge);
    visit("sway", "to starboard", self.sway);
    visit("heave", "vertically", self.heave);
    visit("roll", "about the forward axis", self.roll);
    visit("pitch", "about the starboard axis", self.pitch);
    visit("heading", "about the vertical", self.heading);
  }
};

frames::Vec2 towards(double speed, double heading_rad) {
  return {speed * std::sin(heading_rad), speed * std::cos(heading_rad)};
}

struct Flow {
  double speed_mps = 0.0, heading_rad = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("speed_mps", "m/s", must(in(0, 10)), "speed of the water, of a stream the strongest", self.speed_mps);
    visit("heading_deg", "deg", must(in(-360, 360)), "where it flows to, of a stream the flood", self.heading_rad);
  }
};

struct FlowAtDepth : Flow {
  double depth_m = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("depth_m", "m", must(in(0, 12000)), "depth below chart datum; depths rise", self.depth_m);
    Flow::parameters(self, visit);
  }
};

/// How far a tidal constituent lags.
struct Phase {
  double phase_rad = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("phase_deg", "deg", in(-360, 360), "how far high water, or the strongest flood, comes after reference_utc",
          self.phase_rad);
  }
};

struct Sinkage : vertical::Sinkage {
  static void parameters(auto& self, auto&& visit) {
    visit("speed_mps", "m/s", must(in(0, 30)), "speed through the water; speeds rise", self.speed_mps);
    visit("lower_m", "m", must(in(-2, 5)), "how much deeper the reference point runs than at rest", self.lower_m);
  }
};

struct Load {
  double deeper_m = 0.0, per_hour_m = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("deeper_m", "m", in(-10, 10), "by the load at the start", self.deeper_m);
    visit("deeper_m_per_hour", "", in(-1, 1), "m per hour; burnt fuel makes it negative", self.per_hour_m);
  }
};

}  // namespace

ParameterList disturbance_list() {
  ParameterList list = parameters_of<DisturbancePreset>();
  for (ParameterInfo& info : parameters_of<DisturbanceInFile>()) list.push_back(std::move(info));
  return list;
}

ParameterList constituent_list() {
  ParameterList list = parameters_of<Phase>();
  list.push_back(text_info("constituent", "name of the tidal constituent, such as M2", true));
  list.push_back(text_info("reference_utc", "time that the phase refers to; left out: the scenario's start"));
  return list;
}

ParameterList current_list() {
  ParameterList stream = constituent_list();
  for (ParameterInfo& info : parameters_of<Flow>()) stream.push_back(std::move(info));
  return {list_info("profile", "a steady current by depth, the same everywhere", parameters_of<FlowAtDepth>()),
          list_info("streams", "tidal streams, from the surface to the bed alike", stream)};
}

ParameterList loading_list() {
  ParameterList list = parameters_of<Load>();
  list.push_back(list_info("settlement", "settlement and squat by speed", parameters_of<Sinkage>()));
  return list;
}

motion::DisturbanceParameters read_disturbance(ConfigReader from) {
  DisturbancePreset named;
  read_parameters(from, named);
  DisturbanceInFile values;
  if (!named.preset.empty()) values = DisturbanceInFile(*motion::disturbance_preset(named.preset));
  read_parameters(from, values);
  const motion::DisturbanceParameters p = values.si();
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
    FlowAtDepth flow;
    read_parameters(item, flow);
    const motion::Current::Knot knot{flow.depth_m, towards(flow.speed_mps, flow.heading_rad)};
    if (!current.profile.empty() && knot.depth_m <= current.profile.back().depth_m) {
      item.problem("depth_m", "is not below the depth before it; depths rise");
    }
    current.profile.push_back(knot);
  }
  for (auto& item : from.list("streams")) {
    Flow flow;
    Phase phase;
    motion::Current::Stream stream;
    stream.speed_radps = read_constituent_radps(item);
    read_parameters(item, flow);
    read_parameters(item, phase);
    stream.amplitude_enu_mps = towards(flow.speed_mps, flow.heading_rad);
    stream.phase_rad = phase_at_start_rad(item, phase.phase_rad, stream.speed_radps, start_unix_s);
    current.streams.push_back(stream);
  }
  return current;
}

vertical::Loading read_loading(ConfigReader from) {
  vertical::Loading loading;
  for (auto& item : from.list("settlement")) {
    Sinkage sinkage;
    read_parameters(item, sinkage);
    if (!loading.settlement.empty() && sinkage.speed_mps <= loading.settlement.back().speed_mps) {
      item.problem("speed_mps", "is not above the speed before it; speeds rise");
    }
    loading.settlement.push_back(sinkage);
  }
  Load load;
  read_parameters(from, load);
  loading.change_m = load.deeper_m;
  loading.rate_mps = load.per_hour_m / 3600.0;
  return loading;
}

}  // namespace ensonify

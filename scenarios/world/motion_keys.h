#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "components/config/parameters.h"
#include "kernels/vehicle/motion/current.h"
#include "kernels/vehicle/motion/disturbance.h"
#include "kernels/vehicle/vertical/floating.h"

/// What moves a vehicle besides its guidance, as a scenario's file has it: an irregular sea, the current, its load.
namespace ensonify {

void axis_parameters(auto& axis, auto&& visit, const char* oscillation, const char* wander, const char* unit,
                     double most) {
  visit(oscillation, unit, in(0, most), "standard deviation of the oscillation", axis.oscillation_sd);
  visit("period_s", "s", in(0.2, 200), "period of the oscillation's spectral peak", axis.period_s);
  visit("jitter", "", in(0.02, 0.5), "standard deviation of its frequency over the mean", axis.jitter);
  visit("coherence", "", in(0, 1), "coherence of the oscillation with the common wave", axis.coherence);
  visit("lead_deg", "deg", in(-360, 360), "lead of the oscillation over the common wave", axis.lead_rad);
  visit(wander, unit, in(0, most), "standard deviation of the fractional part", axis.wander_sd);
  visit("hurst", "", in(0.01, 0.99), "roughness of the fractional part: near 0 rough, near 1 smooth", axis.hurst);
  visit("return_s", "s", in(0.1, 1e6), "time constant with which it is pulled back", axis.return_s);
}
struct ShiftKeys : motion::AxisDisturbance {
  static void parameters(auto& self, auto&& visit) {
    axis_parameters(self, visit, "oscillation_m", "wander_m", "m", 20.0);
  }
};
struct TurnKeys : motion::AxisDisturbance {
  static void parameters(auto& self, auto&& visit) {
    axis_parameters(self, visit, "oscillation_deg", "wander_deg", "deg", 60.0);
  }
};

/// `disturbance:` of a vehicle: a preset, and axes that differ from it.
struct DisturbanceKeys {
  std::string preset;
  double highest_hz;
  ShiftKeys surge, sway, heave;
  TurnKeys roll, pitch, heading;

  explicit DisturbanceKeys(const motion::DisturbanceParameters& of)
      : highest_hz(of.highest_hz),
        surge{of.surge},
        sway{of.sway},
        heave{of.heave},
        roll{of.roll},
        pitch{of.pitch},
        heading{of.heading} {}
  DisturbanceKeys() : DisturbanceKeys(motion::DisturbanceParameters{}) {}
  motion::DisturbanceParameters si() const { return {surge, sway, heave, roll, pitch, heading, highest_hz}; }

  static void parameters(auto& self, auto&& visit) {
    Allowed presets;
    for (const std::string_view name : motion::kDisturbancePresets)
      presets.words.emplace_back(std::string(name).c_str());
    visit("preset", "", computed(presets), "a published motion; what stands beside it differs", self.preset);
    visit("highest_hz", "Hz", in(0.01, 50), "nothing moves faster", self.highest_hz);
    visit("surge", "oscillation forward", self.surge);
    visit("sway", "oscillation to starboard", self.sway);
    visit("heave", "oscillation vertically", self.heave);
    visit("roll", "oscillation about the forward axis", self.roll);
    visit("pitch", "oscillation about the starboard axis", self.pitch);
    visit("heading", "about the vertical", self.heading);
  }
  void read_base(ConfigReader& from);
  void check(const ConfigReader& from) const;
};

struct FlowKeys {
  double speed_mps = 0.0, heading_rad = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("speed_mps", "m/s", must(in(0, 10)), "speed of the water, of a stream the strongest", self.speed_mps);
    visit("heading_deg", "deg", must(in(-360, 360)), "heading to which it flows, of a stream the flood",
          self.heading_rad);
  }
};
struct FlowAtDepthKeys : FlowKeys {
  double depth_m = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("depth_m", "m", must(in(0, 12000)), "depth below chart datum; depths rise", self.depth_m);
    FlowKeys::parameters(self, visit);
  }
};

/// A tidal constituent, of a tide or a stream.
struct ConstituentKeys {
  std::string constituent, reference_utc;
  double phase_rad = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("constituent", "", must(any()), "name of the tidal constituent, such as M2", self.constituent);
    visit("phase_deg", "deg", in(-360, 360), "phase of high water, or of the strongest flood, after reference_utc",
          self.phase_rad);
    visit("reference_utc", "", computed(any()), "time that the phase refers to; left out: the scenario's start",
          self.reference_utc);
  }
  void check(const ConfigReader& from) const;
  double speed_radps() const;
  /// Phase at sim time 0.
  double phase_at_start_rad(double start_unix_s) const;
};
struct StreamKeys : ConstituentKeys {
  FlowKeys flow;

  static void parameters(auto& self, auto&& visit) {
    ConstituentKeys::parameters(self, visit);
    FlowKeys::parameters(self.flow, visit);
  }
};

/// `current:` of a scenario.
struct CurrentKeys {
  std::vector<FlowAtDepthKeys> profile;
  std::vector<StreamKeys> streams;

  static void parameters(auto& self, auto&& visit) {
    visit("profile", "steady current by depth, equal everywhere", self.profile);
    visit("streams", "tidal streams, from the surface to the bed alike", self.streams);
  }
  void check(const ConfigReader& from) const;
  motion::Current current(double start_unix_s) const;
};

struct SinkageKeys : vertical::Sinkage {
  static void parameters(auto& self, auto&& visit) {
    visit("speed_mps", "m/s", must(in(0, 30)), "speed through the water; speeds rise", self.speed_mps);
    visit("lower_m", "m", must(in(-2, 5)), "depth that the reference point runs deeper than at rest", self.lower_m);
  }
};

/// `floats:` of a vehicle: settlement and loading.
struct LoadingKeys {
  double deeper_m = 0.0, per_hour_m = 0.0;
  std::vector<SinkageKeys> settlement;

  static void parameters(auto& self, auto&& visit) {
    visit("deeper_m", "m", in(-10, 10), "depth that the load at the start adds", self.deeper_m);
    visit("deeper_m_per_hour", "", in(-1, 1), "m per hour; burnt fuel makes it negative", self.per_hour_m);
    visit("settlement", "settlement and squat by speed", self.settlement);
  }
  void check(const ConfigReader& from) const;
  vertical::Loading loading() const;
};

}  // namespace ensonify

#pragma once

#include <string>

#include "components/sonar/head_config.h"

namespace ensonify {

/// A profiling sonar: one narrow conical beam along the head's down axis.
struct ProfilerConfig : HeadConfig {
  static constexpr double kFastest_hz = 50.0;

  double frequency_hz = 675e3;
  double beamwidth_rad = 1.7 * 3.14159265358979323846 / 180.0;
  double source_level_db = 205.0;
  double pulse_length_s = 50e-6;
  double range_m = 50.0;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("frequency_hz", "Hz", in(200e3, 2e6), "frequency of the tone", self.frequency_hz);
    visit("beamwidth_deg", "deg", in(0.5, 10), "beamwidth at -3 dB, one-way", self.beamwidth_rad);
    visit("source_level_db", "dB", in(150, 230), "rms during the pulse, re 1 uPa at 1 m; the most that can be set",
          self.source_level_db);
    visit("pulse_length_s", "s", in(10e-6, 1e-3), "length of the tone", self.pulse_length_s);
    visit("range_m", "m", in(1, 100), "the longest that can be set", self.range_m);
    HeadParameters::parameters(self, visit);
    sound_speed(self, visit);
  }
  static ProfilerConfig read(ConfigReader& from, const World& world, const std::string& process);

  HeadSettings start() const;
  SettingLimits limits() const { return limits_up_to(1.0, range_m, source_level_db); }
  double reception_s(double of_range_m) const { return 2.0 * of_range_m / sound_speed_mps + pulse_length_s; }
};

}  // namespace ensonify

#pragma once

#include <string>

#include "components/sonar/head_config.h"

namespace ensonify {

/// A profiling sonar: one narrow conical beam along the head's down axis.
struct ProfilerConfig : HeadConfig {
  double frequency_hz = 675e3;
  double beamwidth_rad = 1.7 * 3.14159265358979323846 / 180.0;  // one-way, -3 dB
  double source_level_db = 205.0;                               // rms during the pulse, re 1 uPa at 1 m
  double pulse_length_s = 50e-6;
  double range_m = 50.0;

  static ProfilerConfig read(ConfigReader& from, const World& world, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const ProfilerConfig& other) const;

  HeadSettings start() const;
  SettingLimits limits() const { return limits_up_to(1.0, range_m, source_level_db); }
  double reception_s(double of_range_m) const { return 2.0 * of_range_m / sound_speed_mps + pulse_length_s; }
};

}  // namespace ensonify

#pragma once

#include <string>

#include "components/scanning/scan.h"
#include "components/sonar/head_config.h"
#include "components/sonar/ranged_pulse.h"
#include "kernels/acoustics/array/shading.h"

namespace ensonify {

class ConfigReader;

/// A mechanically scanned head: one transducer, a pencil or a fan, that turns step by step about the head's z axis.
struct ScanningConfig : HeadConfig {
  double frequency_hz = 750e3;
  double horizontal_beamwidth_rad = 2.0 * Scan::kDegree;  // -3 dB, one-way
  array::Shading shading;                                 // of the transducer across that width
  double vertical_beamwidth_rad = 25.0 * Scan::kDegree;   // -3 dB, one-way
  double tilt_rad = 0.0;                                  // down from the plane that it turns in
  Scan scan;
  PulseDesign pulse{.length_s = 32e-6, .most_samples = 1200};
  double source_level_db = 207.0;  // rms during the pulse, re 1 uPa at 1 m; the most that can be set
  double range_m = 20.0;           // to start with
  double longest_range_m = 50.0;
  double electronic_noise_db = -200.0;  // as sound in the water, re 1 uPa^2/Hz

  ScanningConfig() {  // what it has other defaults for than heads in general
    ping_rate_hz = 50.0;
    dead_time_s = 20e-3;
    processing_latency_s = 5e-3;
    gain_spreading_db = 0.0;
  }
  static ScanningConfig read(ConfigReader& from, const World& world, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const ScanningConfig& other) const;

  HeadSettings start() const;
  SettingLimits limits() const;
};

}  // namespace ensonify

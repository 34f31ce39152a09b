#pragma once

#include <string>

#include "components/runtime/config/scenario.h"
#include "components/runtime/head/effects.h"
#include "components/runtime/head/ping_timing.h"
#include "components/runtime/head/ranged_pulse.h"
#include "components/runtime/head/samples.h"
#include "components/runtime/head/settings.h"
#include "components/runtime/sim_time.h"
#include "components/scanning/scan.h"

namespace ensonify {

class ConfigReader;

/// A mechanically scanned head: one transducer, a pencil or a fan, that turns step by step about the head's z axis.
struct ScanningConfig {
  double frequency_hz = 750e3;
  double horizontal_beamwidth_rad = 2.0 * Scan::kDegree;  // -3 dB, one-way
  double vertical_beamwidth_rad = 25.0 * Scan::kDegree;   // -3 dB, one-way
  double tilt_rad = 0.0;                                  // down from the plane that it turns in
  Scan scan;
  PulseDesign pulse{.length_s = 32e-6, .most_samples = 1200};
  double source_level_db = 207.0;  // rms during the pulse, re 1 uPa at 1 m; the most that can be set
  double range_m = 20.0;           // to start with
  double longest_range_m = 50.0;
  double ping_rate_hz = 50.0;  // at most; the interval is never less than 2 R / c + dead time
  double dead_time_s = 20e-3;  // in which it turns
  double processing_latency_s = 5e-3;
  double sound_speed_mps = 1500.0;      // believed until the probe at the face tells
  double electronic_noise_db = -200.0;  // as sound in the water, re 1 uPa^2/Hz
  double gain_spreading_db = 0.0;       // gain S log10(R) + 2 A R + O at range R: S,
  double gain_absorption_dbpm = 0.0;    // A,
  double gain_offset_db = 0.0;          // O
  Converter converter;
  double quality = 1.0;  // of the rays (trace::RaySettings)
  Trigger trigger;
  std::vector<OtherHead> interference;  // whom it hears
  Effects effects;

  // From the scenario.
  Scenario world;
  std::string process;
  HeadMounting mounting;

  static ScanningConfig read(ConfigReader& from, const Scenario& scenario, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const ScanningConfig& other) const;

  PingTiming timing() const {
    return {rate_of(ping_rate_hz), from_seconds(dead_time_s), from_seconds(processing_latency_s), trigger,
            interference};
  }
  HeadSettings start() const;
  SettingLimits limits() const;
};

}  // namespace ensonify

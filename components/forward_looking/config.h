#pragma once

#include <string>

#include "components/runtime/config/scenario.h"
#include "components/runtime/head/effects.h"
#include "components/runtime/head/ping_timing.h"
#include "components/runtime/head/ranged_pulse.h"
#include "components/runtime/head/samples.h"
#include "components/runtime/head/settings.h"
#include "components/runtime/sim_time.h"

namespace ensonify {

class ConfigReader;

/// A forward-looking imaging sonar: a receive line along the head's y axis, which makes beams in azimuth about its x
/// axis, and faces that are tall in elevation.
struct ForwardLookingConfig {
  double frequency_hz = 750e3;
  int beams = 512;
  double aperture_rad = 130.0 * kDegree;          // in azimuth, that the beams are spread over; transmission -3 dB
  double beamwidth_rad = 1.0 * kDegree;           // in azimuth, of the unsteered receive array, -3 dB
  double transmit_vertical_rad = 20.0 * kDegree;  // -3 dB, one-way
  double receive_vertical_rad = 20.0 * kDegree;   // -3 dB, one-way
  double tilt_rad = 0.0;                          // of both vertical beams, down from the x axis
  PulseDesign pulse{.chirp = true, .length_s = 100e-6, .bandwidth_hz = 188e3, .most_samples = 2000};
  double source_level_db = 203.0;  // rms during the pulse, re 1 uPa at 1 m; the most that can be set
  double range_m = 20.0;           // to start with
  double longest_range_m = 120.0;
  double ping_rate_hz = 10.0;  // at most; the interval is never less than 2 R / c + dead time
  double dead_time_s = 1e-3;
  double processing_latency_s = 20e-3;  // from the last echo to the published ping
  double sound_speed_mps = 1500.0;      // believed until the probe at the face tells
  double electronic_noise_db = -200.0;  // of each element, as sound in the water, re 1 uPa^2/Hz
  double gain_spreading_db = 30.0;      // gain S log10(R) + 2 A R + O at range R: S,
  double gain_absorption_dbpm = 0.2;    // A,
  double gain_offset_db = 0.0;          // O
  Converter converter;
  double quality = 0.25;  // of the rays (trace::RaySettings)
  Trigger trigger;
  std::vector<OtherHead> interference;  // whom it hears
  Effects effects;

  // From the scenario.
  Scenario world;
  std::string process;
  HeadMounting mounting;

  static ForwardLookingConfig read(ConfigReader& from, const Scenario& scenario, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const ForwardLookingConfig& other) const;

  PingTiming timing() const {
    return {rate_of(ping_rate_hz), from_seconds(dead_time_s), from_seconds(processing_latency_s), trigger,
            interference};
  }
  HeadSettings start() const;
  SettingLimits limits() const;

  static constexpr double kDegree = 3.14159265358979323846 / 180.0;
};

}  // namespace ensonify

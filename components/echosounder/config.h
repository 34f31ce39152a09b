#pragma once

#include <string>

#include "components/runtime/config/scenario.h"
#include "components/runtime/head/effects.h"
#include "components/runtime/head/ping_timing.h"
#include "components/runtime/head/samples.h"
#include "components/runtime/head/settings.h"
#include "components/runtime/sim_time.h"

namespace ensonify {

class ConfigReader;

/// A single-beam echosounder: one piston that looks along the head's z axis, sends a tone and listens.
struct EchosounderConfig {
  enum class Face { kCircular, kSquare };

  double frequency_hz = 200e3;
  Face face = Face::kCircular;
  double beamwidth_rad = 8.0 * kDegree;  // one-way, -3 dB; of a square along its sides
  double source_level_db = 215.0;        // rms during the pulse, re 1 uPa at 1 m
  double pulse_length_s = 100e-6;
  double range_m = 100.0;
  double ping_rate_hz = 10.0;  // at most; the interval is never less than 2 R / c + dead time
  double dead_time_s = 1e-3;
  double processing_latency_s = 20e-3;  // from the last echo to the published ping
  double sound_speed_mps = 1500.0;      // by which the instrument takes time for range
  double gain_spreading_db = 20.0;      // gain S log10(R) + 2 A R + O at range R: S,
  double gain_absorption_dbpm = 0.05;   // A,
  double gain_offset_db = 0.0;          // O
  Converter converter;
  double electronic_noise_db = -200.0;  // as sound in the water, re 1 uPa^2/Hz
  double bottom_threshold_db = 12.0;    // first return over the water column
  double quality = 1.0;                 // of the rays (trace::RaySettings)
  Trigger trigger;
  std::vector<OtherHead> interference;  // whom it hears
  Effects effects;

  // From the scenario.
  Scenario world;
  std::string process;
  HeadMounting mounting;

  static EchosounderConfig read(ConfigReader& from, const Scenario& scenario, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const EchosounderConfig& other) const;

  PingTiming timing() const {
    return {rate_of(ping_rate_hz), from_seconds(dead_time_s), from_seconds(processing_latency_s), trigger,
            interference};
  }
  /// Settings that it starts with, and what a command can make of them.
  HeadSettings start() const;
  SettingLimits limits() const;
  double sample_period_s() const { return 0.5 * pulse_length_s; }
  double listening_s(const HeadSettings& settings) const {
    return 2.0 * settings.range_m / sound_speed_mps + settings.pulse_length_s;
  }

  static constexpr double kDegree = 3.14159265358979323846 / 180.0;
};

}  // namespace ensonify

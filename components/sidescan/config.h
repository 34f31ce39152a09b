#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "components/runtime/config/scenario.h"
#include "components/runtime/head/effects.h"
#include "components/runtime/head/ping_timing.h"
#include "components/runtime/head/samples.h"
#include "components/runtime/head/settings.h"
#include "components/runtime/sim_time.h"
#include "kernels/echo/pulse.h"

namespace ensonify {

class ConfigReader;

/// One frequency of a sidescan: a line array on each side, along the head's x axis, that sends and listens.
struct SidescanChannel {
  std::string name = "main";
  double frequency_hz = 400e3;
  double horizontal_beamwidth_rad = 0.4 * kDegree;  // one-way, -3 dB
  double vertical_beamwidth_rad = 50.0 * kDegree;   // one-way, -3 dB
  double depression_rad = 30.0 * kDegree;           // of each side's axis, below the horizontal of the head
  double back_loss_db = 30.0;                       // one-way, behind the face: what keeps the sides apart
  double source_level_db = 215.0;                   // rms during the pulse, re 1 uPa at 1 m
  bool chirp = false;                               // a linear sweep and its matched filter; else a tone
  double pulse_length_s = 100e-6;
  double bandwidth_hz = 0.0;            // that a chirp sweeps
  double range_m = 100.0;               // the longest that is listened to, slant
  double electronic_noise_db = -200.0;  // as sound in the water, re 1 uPa^2/Hz

  static SidescanChannel read(ConfigReader& from);
  bool operator==(const SidescanChannel&) const = default;

  echo::Pulse pulse(double length_s) const;
  /// Of the echo of one point: two samples per inverse of it are taken.
  double band_hz() const { return chirp ? bandwidth_hz : 1.0 / pulse_length_s; }
  double sample_period_s() const { return 0.5 / band_hz(); }
  /// c / 2B of a chirp, c tau / 2 of a tone.
  double resolution_m(double sound_speed_mps) const { return 0.5 * sound_speed_mps / band_hz(); }

  static constexpr double kDegree = 3.14159265358979323846 / 180.0;
};

/// A sidescan sonar: the frequencies ping together.
struct SidescanConfig {
  std::vector<SidescanChannel> channels{SidescanChannel{}};
  double ping_rate_hz = 30.0;  // at most; the interval is never less than 2 R / c + dead time
  double dead_time_s = 1e-3;
  double processing_latency_s = 20e-3;  // from the last echo to the published ping
  double sound_speed_mps = 1500.0;      // by which the instrument takes time for range
  double gain_spreading_db = 30.0;      // gain S log10(R) + 2 A R + O at range R: S,
  double gain_absorption_dbpm = 0.1;    // A,
  double gain_offset_db = 0.0;          // O
  Converter converter;
  double bottom_threshold_db = 12.0;  // of the bottom track: first return over the water column
  double quality = 1.0;               // of the rays (trace::RaySettings)
  Trigger trigger;
  std::vector<OtherHead> interference;  // whom it hears
  Effects effects;

  // From the scenario.
  Scenario world;
  std::string process;
  HeadMounting mounting;

  static SidescanConfig read(ConfigReader& from, const Scenario& scenario, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const SidescanConfig& other) const;

  PingTiming timing() const {
    return {rate_of(ping_rate_hz), from_seconds(dead_time_s), from_seconds(processing_latency_s), trigger,
            interference};
  }
  /// Settings that a channel starts with, and what a command can make of them.
  HeadSettings start_of(const SidescanChannel& channel) const;
  SettingLimits limits_of(const SidescanChannel& channel) const;
  /// From transmission to the last echo of this range.
  double listening_s(double range_m, double pulse_length_s) const {
    return 2.0 * range_m / sound_speed_mps + pulse_length_s;
  }
};

}  // namespace ensonify

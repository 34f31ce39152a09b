#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "components/sonar/head_config.h"
#include "kernels/acoustics/array/shading.h"
#include "kernels/acoustics/echo/pulse.h"

namespace ensonify {

class ConfigReader;

/// Treatment of the curvature of wave fronts by a line inside L^2 / lambda.
enum class Focus {
  kIdeal,  // pays none: transmits and receives focused at every range, with its far-field pattern
  kEcho,   // sends unfocused; receives focused at the range of each echo
  kFixed,  // sends unfocused; receives focused at one range
  kOff,    // transmits and receives unfocused
};

/// One frequency of a sidescan: a line array on each side, along the head's x axis, that transmits and receives.
struct SidescanChannel {
  std::string name = "main";
  double frequency_hz = 400e3;
  double horizontal_beamwidth_rad = 0.4 * kDegree;  // one-way, -3 dB
  array::Shading shading;                           // of the line, at that width
  double vertical_beamwidth_rad = 50.0 * kDegree;   // one-way, -3 dB
  double depression_rad = 30.0 * kDegree;           // of each side's axis, below the horizontal of the head
  double back_loss_db = 30.0;                       // one-way, behind the face: what keeps the sides apart
  Focus focus = Focus::kIdeal;
  double focus_m = 0.0;            // of kFixed
  double source_level_db = 215.0;  // rms during the pulse, re 1 uPa at 1 m
  bool chirp = false;              // a linear sweep and its matched filter; else a tone
  double pulse_length_s = 100e-6;
  double tapered_fraction = 0.0;  // of a tone's length that rises and falls; its level is that in between
  double bandwidth_hz = 0.0;      // that a chirp sweeps
  echo::Window window = echo::Window::kHamming;  // of its matched filter
  double samples_per_pulse = 2.0;                // of a tone, or per 1 / bandwidth of a chirp
  double range_m = 100.0;                        // the longest of reception, slant
  double electronic_noise_db = -200.0;           // as sound in the water, re 1 uPa^2/Hz

  static SidescanChannel read(ConfigReader& from);
  bool operator==(const SidescanChannel&) const = default;

  echo::Pulse pulse(double length_s) const;
  /// Bandwidth of the echo of one point: samples_per_pulse are taken per inverse of it.
  double band_hz() const { return chirp ? bandwidth_hz : 1.0 / pulse_length_s; }
  double sample_period_s() const { return 1.0 / (samples_per_pulse * band_hz()); }
  /// c / 2B of a chirp, c tau / 2 of a tone.
  double resolution_m(double sound_speed_mps) const { return 0.5 * sound_speed_mps / band_hz(); }

  static constexpr double kDegree = 3.14159265358979323846 / 180.0;
};

/// A sidescan sonar: the frequencies ping together.
struct SidescanConfig : HeadConfig {
  std::vector<SidescanChannel> channels{SidescanChannel{}};
  double bottom_threshold_db = 12.0;  // of the bottom track: first return over the water column

  SidescanConfig() {  // what it has other defaults for than heads in general
    ping_rate_hz = 30.0;
    gain_absorption_dbpm = 0.1;
  }
  static SidescanConfig read(ConfigReader& from, const World& world, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const SidescanConfig& other) const;

  /// Settings that a channel starts with, and what a command can make of them.
  HeadSettings start_of(const SidescanChannel& channel) const;
  SettingLimits limits_of(const SidescanChannel& channel) const;
  /// From transmission to the last echo of this range.
  double reception_s(double range_m, double pulse_length_s) const {
    return 2.0 * range_m / sound_speed_mps + pulse_length_s;
  }
};

}  // namespace ensonify

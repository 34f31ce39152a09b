#pragma once

#include <string>

#include "components/sonar/head_config.h"

namespace ensonify {

class ConfigReader;

/// A single-beam echosounder: one piston that points along the head's z axis, sends a tone and receives.
struct EchosounderConfig : HeadConfig {
  enum class Face { kCircular, kSquare };

  double frequency_hz = 200e3;
  Face face = Face::kCircular;
  double beamwidth_rad = 8.0 * kDegree;  // one-way, -3 dB; of a square along its sides
  double source_level_db = 215.0;        // rms during the pulse, re 1 uPa at 1 m
  double pulse_length_s = 100e-6;
  double tapered_fraction = 0.0;   // of its length, that rises and falls; its level is that in between
  double samples_per_pulse = 2.0;  // of the shortest that can be set
  double range_m = 100.0;
  double electronic_noise_db = -200.0;  // as sound in the water, re 1 uPa^2/Hz
  double bottom_threshold_db = 12.0;    // first return over the water column
  double least_range_m = 2.0;           // nearer, nothing is taken for the bottom

  EchosounderConfig() {  // what it has other defaults for than heads in general
    gain_spreading_db = 20.0;
    gain_absorption_dbpm = 0.05;
  }
  static EchosounderConfig read(ConfigReader& from, const World& world, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const EchosounderConfig& other) const;

  /// Settings that it starts with, and what a command can make of them.
  HeadSettings start() const;
  SettingLimits limits() const;
  double sample_period_s() const { return pulse_length_s / samples_per_pulse; }
  double reception_s(const HeadSettings& settings) const {
    return 2.0 * settings.range_m / sound_speed_mps + settings.pulse_length_s;
  }

  static constexpr double kLeastColumn_m = 1.0;  // of water, that a bottom is judged against
  static constexpr double kDegree = 3.14159265358979323846 / 180.0;
};

}  // namespace ensonify

#pragma once

#include <string>

#include "components/sonar/head_config.h"
#include "components/sonar/ranged_pulse.h"
#include "kernels/acoustics/array/shading.h"

namespace ensonify {

class ConfigReader;

/// A forward-looking imaging sonar: a receive line along the head's y axis, which makes beams in azimuth about its x
/// axis, and faces that are tall in elevation.
struct ForwardLookingConfig : HeadConfig {
  double frequency_hz = 750e3;
  int beams = 512;
  double aperture_rad = 130.0 * kDegree;          // in azimuth, that the beams are spread over; transmission -3 dB
  double beamwidth_rad = 1.0 * kDegree;           // in azimuth, of the unsteered receive array, -3 dB
  array::Shading shading;                         // of the receive array, at that width
  double transmit_vertical_rad = 20.0 * kDegree;  // -3 dB, one-way
  double receive_vertical_rad = 20.0 * kDegree;   // -3 dB, one-way
  double tilt_rad = 0.0;                          // of both vertical beams, down from the x axis
  PulseDesign pulse{.chirp = true, .length_s = 100e-6, .bandwidth_hz = 188e3, .most_samples = 2000};
  double source_level_db = 203.0;  // rms during the pulse, re 1 uPa at 1 m; the most that can be set
  double range_m = 20.0;           // to start with
  double longest_range_m = 120.0;
  double electronic_noise_db = -200.0;  // of each element, as sound in the water, re 1 uPa^2/Hz

  ForwardLookingConfig() {  // what it has other defaults for than heads in general
    gain_absorption_dbpm = 0.2;
    quality = 0.25;
  }
  static ForwardLookingConfig read(ConfigReader& from, const World& world, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const ForwardLookingConfig& other) const;

  HeadSettings start() const;
  SettingLimits limits() const;

  static constexpr double kDegree = 3.14159265358979323846 / 180.0;
};

}  // namespace ensonify

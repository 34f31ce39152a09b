#pragma once

#include <string>

#include "components/sonar/head_config.h"
#include "components/sonar/ranged_pulse.h"

namespace ensonify {

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
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("frequency_hz", "Hz", in(20e3, 1e6), "frequency of the tone", self.frequency_hz);
    visit("face", "", one_of({{"circular", Face::kCircular}, {"square", Face::kSquare}}), "shape of the piston",
          self.face);
    visit("beamwidth_deg", "deg", in(0.5, 40), "beamwidth at -3 dB, one-way; of a square along its sides",
          self.beamwidth_rad);
    visit("source_level_db", "dB", in(-300, kHighest_db),
          "rms during the pulse, re 1 uPa at 1 m; the most that can be set", self.source_level_db);
    visit("pulse_length_s", "s", in(10e-6, kLongestPulse_s), "length of the tone; also the shortest that can be set",
          self.pulse_length_s);
    visit("tapered_fraction", "", in(0, 1), kTaperAbout, self.tapered_fraction);
    visit("samples_per_pulse", "", in(kFewestPerPulse, kMostPerPulse), kSamplesAbout, self.samples_per_pulse);
    visit("range_m", "m", in(1, 2000), "the longest that can be set", self.range_m);
    visit("electronic_noise_db", "dB", in(-200, 150), "electronic noise as sound in the water, re 1 uPa^2/Hz",
          self.electronic_noise_db);
    visit("bottom_threshold_db", "dB", in(3, 40),
          "threshold of the bottom track: the first return over the water column that lasts", self.bottom_threshold_db);
    visit("least_range_m", "m", in(kLeastColumn_m, 2000), "range below which nothing is taken for the bottom",
          self.least_range_m);
    HeadParameters::parameters(self, visit);
    sound_speed(self, visit);
  }
  static EchosounderConfig read(ConfigReader& from, const World& world, const std::string& process);

  /// Settings that it starts with, and what a command can make of them.
  HeadSettings start() const;
  SettingLimits limits() const;
  double sample_period_s() const { return pulse_length_s / samples_per_pulse; }
  double reception_s(const HeadSettings& settings) const {
    return 2.0 * settings.range_m / sound_speed_mps + settings.pulse_length_s;
  }

  static constexpr double kLongestPulse_s = 20e-3;
  static constexpr double kLeastColumn_m = 1.0;  // of water, that a bottom is judged against
  static constexpr double kDegree = 3.14159265358979323846 / 180.0;
};

}  // namespace ensonify

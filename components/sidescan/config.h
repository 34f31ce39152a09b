#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "components/sonar/head_config.h"
#include "components/sonar/line_design.h"
#include "components/sonar/ranged_pulse.h"
#include "kernels/acoustics/array/shading.h"
#include "kernels/acoustics/echo/pulse.h"

namespace ensonify {

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
  bool two_way = false;                             // as given; once read, the width is one-way
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

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("name", "", must(any()), "name of the channel, whose ports are ping_NAME and bottom_NAME", self.name);
    visit("frequency_hz", "Hz", must(in(50e3, 2e6)), "centre frequency", self.frequency_hz);
    visit("horizontal_beamwidth_deg", "deg", in(0.05, 10),
          "beamwidth at -3 dB of the line along x that transmits and receives", self.horizontal_beamwidth_rad);
    visit("horizontal_beamwidth_is", "", one_of({{"one_way", false}, {"two_way", true}}),
          "two_way: of both together, 0.72 times as wide", self.two_way);
    visit("shading", "shading of the line, which is as long as it takes for its width; with focus: ideal",
          self.shading);
    visit("vertical_beamwidth_deg", "deg", in(5, 150), "vertical beamwidth at -3 dB, one-way",
          self.vertical_beamwidth_rad);
    visit("depression_deg", "deg", in(0, 90), "depression of each side's axis, below the horizontal of the head",
          self.depression_rad);
    visit("back_loss_db", "dB", in(0, 100), "one-way, behind the face: what keeps the sides apart", self.back_loss_db);
    visit("focus", "",
          one_of({{"ideal", Focus::kIdeal}, {"echo", Focus::kEcho}, {"fixed", Focus::kFixed}, {"off", Focus::kOff}}),
          "focus of the line inside L^2 / lambda", self.focus);
    visit("focus_m", "m", in(0, 1000), "range at which focus: fixed is focused", self.focus_m);
    visit("source_level_db", "dB", in(-300, HeadParameters::kHighest_db),
          "rms during the pulse, re 1 uPa at 1 m; the most that can be set", self.source_level_db);
    visit("pulse", "", one_of({{"tone", false}, {"chirp", true}}), "a linear sweep and its matched filter, or a tone",
          self.chirp);
    visit("pulse_length_s", "s", in(5e-6, kLongestPulse_s),
          "length of the pulse; of a tone also the shortest that can be set", self.pulse_length_s);
    visit("tapered_fraction", "", in(0, 1), kTaperAbout, self.tapered_fraction);
    visit("bandwidth_hz", "Hz", in(0, 500e3), "bandwidth that a chirp sweeps", self.bandwidth_hz);
    visit("window", "", filter_windows(), "window of a chirp's matched filter", self.window);
    visit("samples_per_pulse", "", in(kFewestPerPulse, kMostPerPulse), kSamplesAbout, self.samples_per_pulse);
    visit("range_m", "m", in(1, 1000), "slant; the longest that can be set", self.range_m);
    visit("electronic_noise_db", "dB", in(-200, 150), "electronic noise as sound in the water, re 1 uPa^2/Hz",
          self.electronic_noise_db);
  }
  void check(const ConfigReader& from) const;

  echo::Pulse pulse(double length_s) const;
  /// Bandwidth of the echo of one point: samples_per_pulse are taken per inverse of it.
  double band_hz() const { return chirp ? bandwidth_hz : 1.0 / pulse_length_s; }
  double sample_period_s() const { return 1.0 / (samples_per_pulse * band_hz()); }
  /// c / 2B of a chirp, c tau / 2 of a tone.
  double resolution_m(double sound_speed_mps) const { return 0.5 * sound_speed_mps / band_hz(); }

  static constexpr double kLongestPulse_s = 20e-3;
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
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("channels", "each frequency; all ping together", self.channels);
    visit("bottom_threshold_db", "dB", in(3, 40),
          "threshold of the bottom track: the first return over the water column", self.bottom_threshold_db);
    HeadParameters::parameters(self, visit);
    label_kinds(self, visit);
    sound_speed(self, visit);
  }
  static SidescanConfig read(ConfigReader& from, const World& world, const std::string& process);

  /// Settings that a channel starts with, and what a command can make of them.
  HeadSettings start_of(const SidescanChannel& channel) const;
  SettingLimits limits_of(const SidescanChannel& channel) const;
  /// From transmission to the last echo of this range.
  double reception_s(double range_m, double pulse_length_s) const {
    return 2.0 * range_m / sound_speed_mps + pulse_length_s;
  }
};

}  // namespace ensonify

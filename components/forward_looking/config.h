#pragma once

#include <string>

#include "components/sonar/head_config.h"
#include "components/sonar/line_design.h"
#include "components/sonar/ranged_pulse.h"
#include "kernels/acoustics/array/shading.h"

namespace ensonify {

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
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("frequency_hz", "Hz", in(50e3, 3e6), "centre frequency", self.frequency_hz);
    visit("beams", "", in(16, 1024), "number of beams, in azimuth", self.beams);
    visit("aperture_deg", "deg", in(10, 160),
          "width of the fan in azimuth: beams are spread over it, the transmission is -3 dB at its edges",
          self.aperture_rad);
    visit("beamwidth_deg", "deg", in(0.2, 10),
          "beamwidth of the receive array in azimuth; a steered beam is wider by 1 / cos", self.beamwidth_rad);
    visit("shading", "shading of the receive array, which is as long as it takes for its width", self.shading);
    visit("transmit_vertical_deg", "deg", in(1, 90), "vertical beamwidth of the transmitter at -3 dB, one-way",
          self.transmit_vertical_rad);
    visit("receive_vertical_deg", "deg", in(1, 90), "vertical beamwidth of the receiver at -3 dB, one-way",
          self.receive_vertical_rad);
    visit("tilt_deg", "deg", in(-90, 90), "tilt of both vertical beams, down from the head's forward axis",
          self.tilt_rad);
    visit("electronic_noise_db", "dB", in(-200, 150),
          "electronic noise of each element, as sound in the water, re 1 uPa^2/Hz", self.electronic_noise_db);
    visit("pulse", "", one_of({{"tone", false}, {"chirp", true}}), "a linear sweep and its matched filter, or a tone",
          self.pulse.chirp);
    const Allowed bandwidths = in(1e3, 1e6);  // of a tone it is not said
    visit("bandwidth_hz", "Hz", self.pulse.chirp ? bandwidths : computed(bandwidths),
          "bandwidth that a chirp sweeps at most", self.pulse.bandwidth_hz);
    visit("window", "", filter_windows(), "window of a chirp's matched filter", self.pulse.window);
    PulseDesign::parameters(self.pulse, visit);
    visit("source_level_db", "dB", in(-300, kHighest_db),
          "rms during the pulse, re 1 uPa at 1 m; the most that can be set", self.source_level_db);
    visit("range_m", "m", in(0.5, 1000), "range at the start", self.range_m);
    visit("longest_range_m", "m", in(0.5, 1000), "longest range that can be set", self.longest_range_m);
    HeadParameters::parameters(self, visit);
    label_kinds(self, visit);
    sound_speed(self, visit);
  }
  static ForwardLookingConfig read(ConfigReader& from, const World& world, const std::string& process);

  HeadSettings start() const;
  SettingLimits limits() const;

  static constexpr double kDegree = 3.14159265358979323846 / 180.0;
};

}  // namespace ensonify

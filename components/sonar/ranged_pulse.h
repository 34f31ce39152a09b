#pragma once

#include "components/config/parameters.h"
#include "components/sonar/settings.h"
#include "kernels/acoustics/echo/image.h"
#include "kernels/acoustics/echo/pulse.h"
#include "messages/sonar.h"

namespace ensonify {

/// Complex samples per pulse of a tone, or per 1 / B of a chirp. Fewer would let echoes fall between them. Rectangular
/// tones that arrive 1.2 pulses apart leave a fifth of a pulse between them: from 6 on, a sample finds it wherever
/// it lies.
constexpr double kFewestPerPulse = 2.0, kMostPerPulse = 20.0;

// Sentences of parameters that several heads have.
inline constexpr const char* kTaperAbout = "part of a tone's length that rises and falls as a raised cosine";
inline constexpr const char* kSamplesAbout =
    "samples per pulse of a tone, or per 1 / bandwidth of a chirp; from 6 on, points 1.2 cells apart are two wherever "
    "they lie";

/// The pulse of a head that records a limited number of samples per beam, whatever its range: an imaging head, whose
/// operator sees a picture of some hundred rows. samples_per_pulse are taken per 1 / B; where they would not reach the
/// range, B is lowered: a chirp sweeps less, a tone lasts longer. An operator may hold a length: it then is that of the
/// pulse at every range which it suits.
struct PulseDesign {
  bool chirp = false;                            // a linear sweep and its matched filter; else a tone
  double length_s = 100e-6;                      // unless held; of a tone, the shortest
  double longest_s = 20e-3;                      // that can be held
  double tapered_fraction = 0.0;                 // of a tone's length, that rises and falls
  double bandwidth_hz = 0.0;                     // that a chirp sweeps at most
  echo::Window window = echo::Window::kHamming;  // of its filter
  double samples_per_pulse = kFewestPerPulse;    // of a tone, or per 1 / B of a chirp
  int most_samples = 2000;                       // per beam

  static constexpr double kShortest_s = 1e-6, kLongest_s = 20e-3;

  /// Parameters of every such pulse. Those of chirps are the head's to list.
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("pulse_length_s", "s", in(kShortest_s, kLongest_s),
          "length of the pulse, unless a command holds one; of a tone the shortest", self.length_s);
    visit("longest_pulse_length_s", "s", in(kShortest_s, kLongest_s), "longest length of the pulse that can be held",
          self.longest_s);
    visit("tapered_fraction", "", in(0, 1), kTaperAbout, self.tapered_fraction);
    visit("samples_per_pulse", "", in(kFewestPerPulse, kMostPerPulse), kSamplesAbout, self.samples_per_pulse);
    visit("most_samples", "", in(64, 20000),
          "per ping and beam; where they do not reach the range, the band is lowered", self.most_samples);
  }
  void check(const ConfigReader& from) const;
};

/// Pulse and sampling at one range.
struct RangedPulse {
  double length_s = 0.0;
  double band_hz = 0.0;  // resolution is c / 2 of it
  echo::Sampling sampling;

  /// From transmission to the end of the last echo.
  double reception_s() const { return sampling.count * sampling.period_s + length_s; }
  bool operator==(const RangedPulse& other) const {
    return length_s == other.length_s && band_hz == other.band_hz && sampling.count == other.sampling.count;
  }
};

/// range_m > 0, by the sound speed that the head assumes; held_s is 0 where no length is held. A chirp of less than 4
/// cycles of B x length would be none, and a tone shorter than its samples_per_pulse would fall between them: both
/// are made longer.
RangedPulse pulse_at(const PulseDesign& design, double range_m, double sound_speed_mps, double held_s = 0.0);

/// Lets commands hold a length, and a length of 0 follow the range again.
void allow_held_pulses(const PulseDesign& design, double sound_speed_mps, SettingLimits& limits);

/// No pulse that can be sent at any range up to this one is received for longer.
double longest_reception_s(const PulseDesign& design, double longest_range_m, double sound_speed_mps);

echo::Pulse echo_pulse(const PulseDesign& design, const RangedPulse& pulse);

/// Adds a problem where a chirp has tapered ends, as only tones do (echo::tapered_pulse). A chirp has a window instead.
void check_taper(const ConfigReader& from, bool chirp, double tapered_fraction);

/// Gives what kind of pulse is sent.
void fill_shape(bool chirp, double tapered_fraction, msg::AppliedSettings& applied);

}  // namespace ensonify

#pragma once

#include "kernels/echo/image.h"
#include "kernels/echo/pulse.h"

namespace ensonify {

/// The pulse of a head that records a limited number of samples per beam, whatever its range: an imaging head, whose
/// operator sees a picture of some hundred rows. Two samples are taken per 1 / B; where they would not reach the range,
/// B is lowered: a chirp sweeps less, a tone lasts longer.
struct PulseDesign {
  bool chirp = false;                            // a linear sweep and its matched filter; else a tone
  double length_s = 100e-6;                      // of a tone, the shortest
  double bandwidth_hz = 0.0;                     // that a chirp sweeps at most
  echo::Window window = echo::Window::kHamming;  // of its filter
  int most_samples = 2000;                       // per beam

  bool operator==(const PulseDesign&) const = default;
};

/// What is sent and sampled at one range.
struct RangedPulse {
  double length_s = 0.0;
  double band_hz = 0.0;  // resolution is c / 2 of it
  echo::Sampling sampling;

  /// From transmission to the end of the last echo.
  double listening_s() const { return sampling.count * sampling.period_s + length_s; }
  bool operator==(const RangedPulse& other) const {
    return length_s == other.length_s && band_hz == other.band_hz && sampling.count == other.sampling.count;
  }
};

/// range_m > 0, by the sound speed that the head believes. A chirp of less than 4 cycles of B x length would be none:
/// it is made longer.
RangedPulse pulse_at(const PulseDesign& design, double range_m, double sound_speed_mps);

echo::Pulse echo_pulse(const PulseDesign& design, const RangedPulse& pulse);

}  // namespace ensonify

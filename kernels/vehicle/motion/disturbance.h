#pragma once

#include <array>
#include <vector>

#include "kernels/base/random/stream.h"
#include "kernels/vehicle/motion/excursion.h"

namespace ensonify::motion {

/// Disturbance of one axis, in the axis' own unit (m or rad). Two parts: an oscillation whose frequency jitters about
/// its mean, and fractional Brownian motion that is pulled back to the axis.
struct AxisDisturbance {
  double oscillation_sd = 0.0;  // standard deviation, >= 0
  double period_s = 8.0;        // of the spectrum's peak, up to 200 and above 1 / highest_hz
  double jitter = 0.2;          // standard deviation of the frequency over its mean, 0.02 .. 0.5
  double coherence = 0.0;       // of the oscillation with the common wave, 0 .. 1
  double lead_rad = 0.0;        // how far it is ahead of the common wave
  double wander_sd = 0.0;       // standard deviation of the fractional part, >= 0
  double hurst = 0.5;           // its roughness: near 0 rough, near 1 smooth; 0.5 is Brownian motion
  double return_s = 60.0;       // time constant of the pull, > 0
};

struct DisturbanceParameters {
  AxisDisturbance surge, sway, heave, roll, pitch, heading;
  double highest_hz = 2.0;  // nothing moves faster; > 0
};

/// A random motion of six axes, a function of time alone.
///
/// Each axis is a sum of waves, one for each of 256 narrow bands between 1/500 s and `highest_hz`; the wave's frequency
/// is drawn within its band, so that the motion never repeats, and its phase is uniform [Rice1944]. The amplitudes are
/// those of the spectrum: for the oscillation a Gaussian peak of relative width `jitter` at 1 / `period_s`, for the
/// fractional part (f^2 + f_c^2)^-(H + 1/2) with f_c = 1 / (2 pi return_s), which is fractional Brownian motion's
/// f^-(2H + 1) [Mandelbrot1968] above f_c and flat below. Each part has its standard deviation whatever the bands cut
/// off. A part `coherence` of every oscillation follows one wave common to all axes: two axes have the coherence c1 c2.
///
/// Rates and accelerations are derivatives of these very sums, so they are exact. Equal streams give equal motions;
/// every axis draws its own numbers, so that changing one axis moves no other.
class Disturbance {
 public:
  /// Throws std::invalid_argument for a parameter outside what is said above.
  Disturbance(const DisturbanceParameters& parameters, const random::Stream& stream);

  Excursion at(double t_s) const;

 private:
  static constexpr std::size_t kAxes = 6;
  struct Wave {
    double omega_radps;
    std::array<double, kAxes> cosine, sine;  // amplitudes
  };
  std::vector<Wave> waves_;  // empty when nothing is disturbed
};

}  // namespace ensonify::motion

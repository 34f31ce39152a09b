#pragma once

#include <array>
#include <optional>
#include <string_view>
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

/// The motion of vessels that were measured, and of some that were not. Nothing for another name.
///
/// - research_ship: a ship of 94 m at 9.5 kn in a swell of 10 to 13 s, from ten minutes of the motion sensor of R/V
///   Nathaniel B. Palmer at 1 Hz (1 August 2014): standard deviations roll 0.58, pitch 1.86, heading 0.66 degrees,
///   heave 1.12 m; peaks at 12.8, 9.1 and 10.7 s; coherence with heave 0.54 (roll) and 0.87 (pitch), pitch a quarter of
///   a period from heave. The sign of that quarter, and how heading divides into waves and wander, are assumed.
/// - survey_launch: a small boat in sheltered water: standard deviations roll 1.7, pitch 0.8 degrees, heave 0.03 m, as
/// on
///   a multibeam test line of an unnamed launch; periods and coherence assumed.
/// - auv: a small AUV below the waves; all assumed.
std::optional<DisturbanceParameters> disturbance_preset(std::string_view name);

inline constexpr std::string_view kDisturbancePresets[] = {"research_ship", "survey_launch", "auv"};

}  // namespace ensonify::motion

#pragma once

#include <functional>

#include "kernels/seabed/law.h"

/// What the tests of the whole chain are judged by: the integral over the seabed, in the seabed's own coordinates.
namespace ensonify::physics {

/// A level seabed below a level head, in water where sound travels straight.
struct LevelSeabed {
  double altitude_m = 20.0;  // of the head
  double absorption_dbpm = 0.0;
  double sound_speed_mps = 1500.0;
  seabed::Law backscatter;
};

/// Transmit times receive power pattern against the direction cosines in the head's frame: forward, starboard, down.
using TwoWayPattern = std::function<double(double forward, double starboard, double down)>;

/// A tone of this level and length, and where it goes.
struct Tone {
  double source_level_db = 220.0;
  double pulse_length_s = 100e-6;
  TwoWayPattern pattern;
  double finest_sine = 0.02;  // lambda / L of the longest line in the pattern
};

/// Mean-square pressure at a time after the start of transmission, uPa^2:
///
///   p0^2 Integral over c (t - tau) / 2 <= R <= c t / 2 of b_T b_R sigma R^-4 10^(-2 alpha R / 10) dA,
///
/// with dA = R dR dpsi in polar coordinates about the point below the head. No ray, no tube and no code of
/// kernels/acoustics/trace or kernels/acoustics/echo in it. The rule in psi is exact for patterns of uniform lines but
/// for 1e-3 of a dB.
double mean_square_upa2(const LevelSeabed& seabed, const Tone& tone, double time_s);

/// Power pattern of `elements` points `spacing_in_waves` apart, steered to a sine: (sin N x / N sin x)^2,
/// x = pi spacing (sine - steer) [Lurton2010, ch. 5].
double elements_power(int elements, double spacing_in_waves, double sine, double sin_steer);

/// 10 log10.
double db(double ratio);

}  // namespace ensonify::physics

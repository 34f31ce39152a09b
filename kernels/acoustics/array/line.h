#pragma once

#include "kernels/acoustics/array/beam_layout.h"

/// Patterns of continuous uniform lines, in closed form (line_array.h has arrays of weighted elements). They are
/// functions of the sine of the angle from the plane across the line (one direction cosine of the physical array),
/// because a line array's beams are cones; all angles here are that angle. Far field only.
namespace ensonify::array {

/// sin(pi x) / (pi x).
double sinc(double x);

/// Amplitude pattern, with sign, of a uniform line `length_in_waves` = L / lambda long, steered to `sin_steer`; 1 on
/// its axis. First sidelobes -13.26, -17.83, -20.79 dB [Lurton2010, ch. 5].
double line_amplitude(double length_in_waves, double sin_angle, double sin_steer = 0.0);

/// Power pattern, the square of line_amplitude.
double line_power(double length_in_waves, double sin_angle, double sin_steer = 0.0);

/// Integral of line_power over sine: lambda / L. (Over angle it is that divided by cos(steer).)
double equivalent_width(double length_in_waves);

/// Half-power half width in sine: 0.44295 lambda / L.
double half_power_half_width(double length_in_waves);

/// Full half-power width of the steered beam in angle, rad; exact. Infinite-cone edges beyond 90 deg are cut there.
double half_power_width_rad(double length_in_waves, double steer_rad = 0.0);

/// The length L / lambda whose unsteered half-power width is `width_rad`. Precondition: 0 < width_rad < pi.
double length_in_waves_for(double width_rad);

/// Directivity index of a plane rectangular aperture of both lengths, dB: 10 log10(4 pi Lx Ly / lambda^2) [Lurton2010].
double directivity_index_db(double length_in_waves, double width_in_waves);

}  // namespace ensonify::array

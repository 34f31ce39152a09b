#pragma once

/// The sea surface, seen from below.
namespace ensonify::surface {

/// Backscattering cross sections per unit area and solid angle (ratios, not dB), by cause.
struct SurfaceBackscatter {
  double facets = 0.0;          // mirror-like wave slopes, near normal incidence
  double ripples = 0.0;         // small waves, at moderate and low grazing
  double interface = 0.0;       // the two blended, before bubbles take their share
  double bubble_loss_db = 0.0;  // two-way loss of the interface's echo in the bubbles below it, >= 0
  double bubbles = 0.0;         // scattered by the bubbles themselves
  double total = 0.0;           // interface after the loss, and bubbles
};

/// Backscatter of the sea surface after [APL1994] section II.B.
///
/// 10..100 kHz, accuracy 4-5 dB; above 100 kHz an extrapolation. Wind speed at 10 m above the sea, m/s, 0 or more; at
/// high wind and frequency the loss hides the interface and only bubbles are left. Grazing angle from the mean surface:
/// clamped to 0.001..90 degrees.
///
/// Two readings of the report: ripples grow with the square of the wind (its figure for 70 kHz and 8 m/s agrees with
/// that, not with the first power), and above 85 degrees, where tan^4 runs away under the blend, they keep the value at
/// 85. The facets are meant for a flat mean surface: where the wave mesh already carries slopes, only those it does not
/// resolve belong in here.
/// @throws std::invalid_argument for a frequency that is not positive or a wind speed below 0.
SurfaceBackscatter sea_surface_backscatter(double grazing_rad, double frequency_hz, double wind_speed_mps);

/// Mean-square slope of the wind sea in the report's facets (a ratio): 0.0046 ln(2.1 U^2), U >= 1; 0.0034 below.
double mean_square_slope(double wind_speed_mps);

/// Coherent reflection as a factor of pressure: -exp(-2 (k sigma_h sin(grazing))^2), the coherent
/// reflection of a Gaussian surface in the Kirchhoff approximation [Ogilvy1991]. The sign is the phase flip at a
/// surface that yields. 0 sigma_h is a mirror. Grazing 0..pi/2.
double coherent_reflection(double wavenumber_radpm, double rms_height_m, double grazing_rad);

/// Rms height of a fully developed wind sea in m: a quarter of the significant height 0.2092 V^2 / g of Pierson and
/// Moskowitz [Pierson1964], V the wind at 19.5 m in m/s.
double rms_wave_height_m(double wind_speed_mps);

}  // namespace ensonify::surface

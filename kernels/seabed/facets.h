#pragma once

namespace ensonify::seabed {

/// Backscattering cross section per unit area (a ratio, not dB) of mirror-like facets with Gaussian slopes, that
/// reflect all: exp(-tan^2 g / s^2) / (4 pi s^2 cos^4 g), g the incidence angle from 0 to below pi/2, s^2 the
/// mean-square slope, both directions together, > 0. The high-frequency limit of the Kirchhoff approximation
/// [Ogilvy1991]. Seen from where the sound came it holds all energy: 4 Integral sigma cos g dOmega = 1.
double facet_backscatter(double sin_grazing, double mean_square_slope);

}  // namespace ensonify::seabed

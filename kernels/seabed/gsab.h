#pragma once

namespace ensonify::seabed {

/// Generic seafloor acoustic backscatter [Lamarche2011]: a description of measured angular curves, to be fitted; it
/// holds no physics and no frequency. Amplitudes are ratios (10^(dB/10)), widths are standard deviations of incidence
/// angle.
struct Gsab {
  double specular = 0.0;              // A, >= 0
  double specular_width_rad = 0.1;    // B, > 0
  double diffuse = 0.0;               // C, >= 0: level at normal incidence of the Lambert-like part
  double diffuse_exponent = 2.0;      // D, >= 0: 2 is Lambert's law
  double transition = 0.0;            // E, >= 0: shoulder at moderate incidence
  double transition_width_rad = 0.3;  // F, > 0
};

/// Backscattering cross section per unit area (a ratio, not dB):
/// A exp(-phi^2 / 2 B^2) + C cos^D phi + E exp(-phi^2 / 2 F^2), phi the incidence angle.
/// Grazing angle from the local plane of the seabed, clamped to 0..pi/2.
/// @throws std::invalid_argument for a width that is not above 0.
double gsab_backscatter(const Gsab& curve, double grazing_rad);

}  // namespace ensonify::seabed

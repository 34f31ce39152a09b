#pragma once

#include <complex>

#include "kernels/seabed/sediment.h"

namespace ensonify::seabed {

/// Backscattering cross sections per unit area and solid angle (ratios, not dB), by cause.
struct BackscatterParts {
  double kirchhoff = 0.0;        // facets of a gently rough surface; near normal incidence, 0 below 40 degrees
  double composite = 0.0;        // Bragg scattering from small relief that is tilted and shadowed by larger relief
  double large_roughness = 0.0;  // the report's empirical law for gravel and rock
  double roughness = 0.0;        // the three blended
  double volume = 0.0;           // from inside the sediment
  double total = 0.0;            // roughness + volume
};

/// Whether the report states an accuracy: parameters in range and 10..100 kHz.
bool in_range(const SedimentParameters& sediment, double frequency_hz);

/// Backscatter of the seabed after [APL1994] section IV.C at one frequency.
///
/// Frequencies 10..100 kHz and parameters in_range(); accuracy there about 3 dB (well-known sand and silt above 5
/// degrees of grazing), 5-10 dB otherwise, about 10 dB for rock and gravel. Above 100 kHz it is an extrapolation: it
/// stays finite and smooth, and differs from later models by up to about 3 dB for mud and sand above 20 degrees, 7-19
/// dB for rock (docs/physics/seabed/backscatter.md).
///
/// Grazing angle from the local plane of the seabed: clamped to 0.001..90 degrees, as the report recommends. The scale:
/// relief that the terrain mesh resolves must not be in the parameters too.
class SedimentBackscatter {
 public:
  /// sound_speed_mps: of the water at the seabed.
  /// @throws std::invalid_argument for parameters that the formulae cannot take: not finite, a ratio, loss, strength,
  /// frequency or sound speed that is not positive, a negative volume parameter, an exponent outside 2..4 (exclusive).
  SedimentBackscatter(const SedimentParameters& sediment, double frequency_hz, double sound_speed_mps);

  BackscatterParts parts(double grazing_rad) const;

  /// Total cross section.
  double operator()(double grazing_rad) const { return parts(grazing_rad).total; }

  /// Slope of relief, rms, that the parameters imply at this frequency (a ratio: tangent of an angle). The report's
  /// theory is for small slopes; above 0.12 (7 degrees) its empirical law takes over.
  double rms_slope() const { return s_; }

 private:
  double kirchhoff(double theta) const;
  double bragg(double theta) const;
  double volume(double theta) const;
  double large_roughness(double theta) const;
  double shadowing(double theta) const;

  SedimentParameters sediment_;
  double alpha_;                // gamma / 2 - 1
  double k_radpcm_;             // wavenumber in the water
  std::complex<double> kappa_;  // sediment's wavenumber over the water's
  double R90_squared_;          // |R|^2 at normal incidence
  double q_, a_, b_;            // of the Kirchhoff law
  double s_;                    // rms slope
  double cos_theta_k_;          // where Kirchhoff and composite laws join
};

}  // namespace ensonify::seabed

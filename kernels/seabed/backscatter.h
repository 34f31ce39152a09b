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

/// Backscattering cross section per unit area (a ratio, not dB) of mirror-like facets with Gaussian slopes, that
/// reflect all: exp(-tan^2 g / s^2) / (4 pi s^2 cos^4 g), g the incidence angle from 0 to below pi/2, s^2 the
/// mean-square slope, both directions together, > 0. The high-frequency limit of the Kirchhoff approximation
/// [Ogilvy1991]. Seen from where the sound came it holds all energy: 4 Integral sigma cos g dOmega = 1.
double facet_backscatter(double sin_grazing, double mean_square_slope);

/// Backscattering cross section per unit area (a ratio, not dB) of a seabed that follows Lambert's law:
/// sigma = mu sin^2(grazing), mu = 10^(mu_db/10) [Lurton2010, ch. 3].
///
/// Grazing angle from the local plane of the seabed, 0..pi/2, given by its sine in [0, 1]. mu_db is the strength at
/// normal incidence, typically -35 (mud) to -10 (rock); a perfect diffuser that returns all energy has -4.97.
double lambert_backscatter(double mu_db, double sin_grazing);

/// The same in dB re 1 m^2 per m^2.
double lambert_strength_db(double mu_db, double sin_grazing);

/// Reflection coefficient of a smooth, lossy fluid seabed for pressure [APL1994, eqs 29-33]. Grazing angle 0..pi/2,
/// clamped to it. Not a function of frequency. Roughness is left out: a rough bottom reflects less.
std::complex<double> reflection_coefficient(const SedimentParameters& sediment, double grazing_rad);

/// Loss of one bounce: -20 log10 |R|, in dB, >= 0.
///
/// The report's accuracy: about the loss itself on soft bottoms, 1-2 dB on hard sand, 20-30 kHz.
double forward_loss_db(const SedimentParameters& sediment, double grazing_rad);

}  // namespace ensonify::seabed

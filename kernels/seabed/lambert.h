#pragma once

namespace ensonify::seabed {

/// Backscattering cross section per unit area (a ratio, not dB) of a seabed that follows Lambert's law:
/// sigma = mu sin^2(grazing), mu = 10^(mu_db/10) [Lurton2010, ch. 3].
///
/// Grazing angle from the local plane of the seabed, 0..pi/2, given by its sine in [0, 1]. mu_db is the strength at
/// normal incidence, typically -35 (mud) to -10 (rock); a perfect diffuser that returns all energy has -4.97.
double lambert_backscatter(double mu_db, double sin_grazing);

/// The same in dB re 1 m^2 per m^2.
double lambert_strength_db(double mu_db, double sin_grazing);

}  // namespace ensonify::seabed

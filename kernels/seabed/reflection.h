#pragma once

#include <complex>

#include "kernels/seabed/sediment.h"

namespace ensonify::seabed {

/// Reflection coefficient of a smooth, lossy fluid seabed for pressure [APL1994, eqs 29-33]. Grazing angle 0..pi/2,
/// clamped to it. Not a function of frequency. Roughness is left out: a rough bottom reflects less.
std::complex<double> reflection_coefficient(const SedimentParameters& sediment, double grazing_rad);

/// Loss of one bounce: -20 log10 |R|, in dB, >= 0.
///
/// The report's accuracy: about the loss itself on soft bottoms, 1-2 dB on hard sand, 20-30 kHz.
double forward_loss_db(const SedimentParameters& sediment, double grazing_rad);

}  // namespace ensonify::seabed

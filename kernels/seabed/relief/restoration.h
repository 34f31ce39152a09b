#pragma once

#include "kernels/seabed/relief/spectrum.h"
#include "kernels/seabed/statistics/surface.h"

namespace ensonify::relief {

/// The detail that a guide of coarse cells lacks, as a spectrum to add to its smooth surface.
///
/// The guide's own spectrum is trusted up to 0.7 of its Nyquist wave number; from there on the relief goes on with the
/// exponent 2 H + 2 and the strength it has there (mean of ln(W K^gamma) over 0.5 to 0.9 Nyquist's). Below, the outer
/// scale of two waves at Nyquist's lets the added relief end where the guide's begins. Six measured sites, thinned and
/// rebuilt so, were matched within 1.3 dB on four with H = 0.625; going on with the guide's own slope was wrong by up
/// to 12 dB.
///
/// Empty where the guide has no whole window of 16 cells. A survey product is often smooth below 6 to 8 of its cells:
/// then `band_start_cells` says where its spectrum is still valid (2: at Nyquist's wave length).
struct Detail {
  Spectrum spectrum;         // rms 0 if there is nothing to go on
  double strength_si = 0.0;  // W = strength K^-(2 H + 2)
};
Detail detail_below(const relief_statistics::Surface& guide, double hurst = 0.625, double band_start_cells = 2.0);

}  // namespace ensonify::relief

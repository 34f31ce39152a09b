#pragma once

#include "kernels/acoustics/detect/beam_series.h"

namespace ensonify::detect {

struct PhaseRamp {
  Estimate crossing;          // sd_s: as an error of the time at the beam's axis
  double angle_sd_rad = 0.0;  // the same error as one of the direction
  double coherence =
      0.0;             // magnitude of the sum of the interferogram turned back by the fit, over the sum of magnitudes
  double slope = 1.0;  // fitted over expected
};

/// Phase detection (bottom.h) of the echo about `near_s`: where the phase between the halves crosses zero. Not found
/// where the beam points within its own width of the seabed's normal, where its footprint echoes for less than two
/// thirds of a pulse, or where it receives nothing.
PhaseRamp fit_phase_ramp(const BeamSeries& series, const ExpectedSeabed& seabed, double near_s,
                         double phase_centres_in_waves);

}  // namespace ensonify::detect

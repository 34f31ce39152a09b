#pragma once

#include "kernels/acoustics/detect/beam_series.h"

namespace ensonify::detect {

/// Half of the window in which the amplitude's centre of gravity is taken: the footprint and the pulse.
double gravity_window_s(const BeamSeries& series, const ExpectedSeabed& seabed, double two_way_s);

/// Amplitude detection (bottom.h) of the echo about `near_s`. loss_np_ps: absorption of power with time, 1/s.
Estimate centre_of_gravity(const BeamSeries& series, const ExpectedSeabed& seabed, double near_s, double noise_power,
                           double loss_np_ps);

}  // namespace ensonify::detect

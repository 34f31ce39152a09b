#pragma once

#include <span>

#include "kernels/acoustics/echo/arrival.h"
#include "kernels/acoustics/echo/image.h"
#include "kernels/acoustics/echo/pulse.h"

namespace ensonify::echo {

/// Images of heads with one receive aperture per channel (sidescan, echosounder, scanning). Row r is the sum of all
/// arrivals of all sets, each times its gain in row r. The image is resized and overwritten. Noise comes from add_noise
/// and RowReverberation. The same bits for any number of threads. `index` is memory: its contents do not matter. Throws
/// std::invalid_argument for a set whose gains do not fit.
void form_apertures(std::span<const EchoSet> echoes, int rows, const SampledPulse& pulse, const Sampling& sampling,
                    TimeIndex& index, Image& image);

}  // namespace ensonify::echo

#pragma once

#include <cstdint>

#include "kernels/acoustics/echo/image.h"
#include "kernels/base/random/stream.h"

namespace ensonify::echo {

/// Adds complex Gaussian noise of mean square 10^(level_db / 10) uPa^2 to every sample: a function of (ping, beam,
/// sample) only.
///
/// White over the sampled band, independent between beams; at most 6.7 standard deviations per component (32-bit
/// uniforms). The level is what remains after beam forming, in the receiver's band. level_db of -infinity adds nothing.
void add_noise(double level_db, std::uint64_t ping, const random::Stream& stream, Image& image);

}  // namespace ensonify::echo

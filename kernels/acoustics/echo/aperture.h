#pragma once

#include <span>

#include "kernels/acoustics/echo/arrival.h"
#include "kernels/acoustics/echo/image.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/acoustics/echo/time_index.h"

namespace ensonify::echo {

/// Heads with one receive aperture per channel (sidescan, echosounder, scanning): arrivals summed into one row each.
class ApertureReceiver {
 public:
  /// Row r of the image is the sum of arrivals, each times gain[r][arrival] (amplitude of the channel's pattern; an
  /// empty span is 1 for all). The image is resized and overwritten. Noise comes from add_noise and
  /// add_reverberation. The same bits for any number of threads.
  void form(std::span<const Arrival> arrivals, std::span<const std::span<const float>> gain, const SampledPulse& pulse,
            const Sampling& sampling, Image& image);

 private:
  TimeIndex index_;
};

}  // namespace ensonify::echo

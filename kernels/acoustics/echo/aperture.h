#pragma once

#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/acoustics/echo/arrival.h"
#include "kernels/acoustics/echo/image.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/acoustics/echo/time_index.h"
#include "kernels/base/random/stream.h"

namespace ensonify::echo {

/// Images of heads with one receive aperture per channel (sidescan, echosounder, scanning). Row r is the sum of all
/// arrivals of all sets, each times its gain in row r. The image is resized and overwritten. Noise comes from
/// RowBackground. The same bits for any number of threads. `index` is memory: its contents do not matter. Throws
/// std::invalid_argument for a set whose gains do not fit.
void form_apertures(std::span<const EchoSet> echoes, int rows, const SampledPulse& pulse, const Sampling& sampling,
                    TimeIndex& index, Image& image);

/// Sound that is there without any arrival, of single apertures. (Line arrays take Background instead.) White before
/// the receiver's filter (SampledPulse::response), so coloured as echoes are: complex Gaussian, independent between
/// rows, at most 6.7 standard deviations per component of each draw (32-bit uniforms). A function of (ping, row,
/// sample) and the filter only.
class RowBackground {
 public:
  /// Adds noise of mean square 10^(level_db / 10) uPa^2 to every sample: what remains of it after beam forming, in the
  /// receiver's band. level_db of -infinity adds nothing.
  void add_noise(double level_db, const SampledPulse& pulse, std::uint64_t ping, const random::Stream& stream,
                 Image& image);

  /// Adds reverberation of these mean squares (sample by row), uPa^2.
  void add_reverberation(std::span<const float> mean_square_upa2, const SampledPulse& pulse, std::uint64_t ping,
                         const random::Stream& stream, Image& image);

 private:
  template <class MeanSquare>
  void add(const MeanSquare& mean_square_upa2, const SampledPulse& pulse, std::uint64_t ping,
           const random::Stream& stream, Image& image);

  std::vector<std::vector<std::complex<float>>> draws_;  // by row
};

}  // namespace ensonify::echo

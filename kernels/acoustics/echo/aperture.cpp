#include "kernels/acoustics/echo/aperture.h"

#include <tbb/parallel_for.h>

#include <stdexcept>

namespace ensonify::echo {

void form_apertures(std::span<const EchoSet> echoes, int rows, const SampledPulse& pulse, const Sampling& sampling,
                    TimeIndex& index, Image& image) {
  for (const EchoSet& set : echoes) {
    if (!set.fits(static_cast<std::size_t>(rows))) {
      throw std::invalid_argument("apertures need one gain per row and arrival, or none");
    }
  }
  index.set(echoes, pulse, sampling);
  image.resize(rows, sampling.count);
  tbb::parallel_for(0, index.blocks(), [&](int block) {
    const int first = block * TimeIndex::kBlock;
    const int count = std::min(TimeIndex::kBlock, sampling.count - first);
    for (int row = 0; row < rows; ++row) std::fill_n(image.row(row).begin() + first, count, std::complex<float>{});
    index.each(block, pulse, [&](std::size_t number, std::size_t i, int from, std::span<const float> envelope) {
      const EchoSet& set = echoes[number];
      for (int row = 0; row < rows; ++row) {
        const std::complex<float> pressure =
            set.gain.empty()
                ? set.arrivals.pressure_upa(i)
                : set.gain[static_cast<std::size_t>(row) * set.arrivals.size() + i] * set.arrivals.pressure_upa(i);
        std::complex<float>* sample = image.row(row).data() + from;
        for (const float e : envelope) *sample++ += e * pressure;
      }
    });
  });
}

}  // namespace ensonify::echo

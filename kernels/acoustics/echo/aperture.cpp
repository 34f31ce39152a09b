#include "kernels/acoustics/echo/aperture.h"

#include <tbb/parallel_for.h>

#include <stdexcept>

namespace ensonify::echo {

void ApertureReceiver::form(std::span<const Arrival> arrivals, std::span<const std::span<const float>> gain,
                            const SampledPulse& pulse, const Sampling& sampling, Image& image) {
  for (const auto& one : gain) {
    if (!one.empty() && one.size() != arrivals.size()) {
      throw std::invalid_argument("an aperture needs one gain per arrival, or none");
    }
  }
  index_.set(arrivals, pulse, sampling);
  image.resize(static_cast<int>(gain.size()), sampling.count);
  tbb::parallel_for(0, index_.blocks(), [&](int block) {
    const int first = block * TimeIndex::kBlock;
    const int count = std::min(TimeIndex::kBlock, sampling.count - first);
    for (int row = 0; row < image.beams; ++row)
      std::fill_n(image.row(row).begin() + first, count, std::complex<float>{});
    index_.each(block, pulse, [&](std::uint32_t i, int from, std::span<const float> envelope) {
      for (int row = 0; row < image.beams; ++row) {
        const auto& gains = gain[static_cast<std::size_t>(row)];
        const std::complex<float> pressure =
            gains.empty() ? arrivals[i].pressure_upa : gains[i] * arrivals[i].pressure_upa;
        std::complex<float>* sample = image.row(row).data() + from;
        for (const float e : envelope) *sample++ += e * pressure;
      }
    });
  });
}

}  // namespace ensonify::echo

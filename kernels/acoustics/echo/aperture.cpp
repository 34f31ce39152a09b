#include "kernels/acoustics/echo/aperture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "kernels/base/profile/profile.h"

namespace ensonify::echo {

void form_apertures(std::span<const EchoSet> echoes, int rows, const SampledPulse& pulse, const Sampling& sampling,
                    TimeIndex& index, Image& image) {
  const profile::Span span(profile::Stage::kBeamform);
  for (const EchoSet& set : echoes) {
    if (!set.fits(static_cast<std::size_t>(rows))) {
      throw std::invalid_argument("apertures need one gain per row and arrival, or none");
    }
  }
  index.set(echoes, pulse, sampling);
  image.resize(rows, sampling.count);
  tbb::parallel_for(0, index.blocks(), [&](int block) {
    const profile::Span part(profile::Stage::kSpread);
    const int first = block * TimeIndex::kBlock;
    const int count = std::min(TimeIndex::kBlock, sampling.count - first);
    for (int row = 0; row < rows; ++row) std::fill_n(image.row(row).begin() + first, count, std::complex<float>{});
    index.each(block, pulse, [&](const Received& received, int from, std::span<const float> envelope) {
      const EchoSet& set = echoes[received.set];
      const std::size_t i = received.arrival;
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

template <class MeanSquare>
void RowBackground::add(const MeanSquare& mean_square_upa2, const SampledPulse& pulse, std::uint64_t ping,
                        const random::Stream& stream, Image& image) {
  const auto response = pulse.response();
  const auto rows = static_cast<std::size_t>(image.beams);
  if (draws_.size() < rows) draws_.resize(rows);
  const profile::Span span(profile::Stage::kBeamform);
  tbb::parallel_for(std::size_t{0}, rows, [&](std::size_t row) {
    const profile::Span part(profile::Stage::kNoise);
    auto& draws = draws_[row];
    draws.assign(static_cast<std::size_t>(image.samples) + response.size(), {});
    random::add_gaussian(stream, ping, std::uint64_t{row} << 32, std::sqrt(0.5F), draws);
    auto out = image.row(static_cast<int>(row));
    for (std::size_t k = 0; k < out.size(); ++k) {
      std::complex<float> sum;
      for (std::size_t i = 0; i < response.size(); ++i) sum += response[i] * draws[k + response.size() - i];
      out[k] += std::sqrt(mean_square_upa2(k, row)) * sum;
    }
  });
}

void RowBackground::add_noise(double level_db, const SampledPulse& pulse, std::uint64_t ping,
                              const random::Stream& stream, Image& image) {
  const auto mean_square = static_cast<float>(power_ratio(level_db));
  if (mean_square > 0.0F) add([=](std::size_t, std::size_t) { return mean_square; }, pulse, ping, stream, image);
}

void RowBackground::add_reverberation(std::span<const float> mean_square_upa2, const SampledPulse& pulse,
                                      std::uint64_t ping, const random::Stream& stream, Image& image) {
  const auto rows = static_cast<std::size_t>(image.beams);
  if (mean_square_upa2.size() != rows * static_cast<std::size_t>(image.samples)) {
    throw std::invalid_argument("reverberation needs one mean square per sample and row");
  }
  add([=](std::size_t k, std::size_t row) { return mean_square_upa2[k * rows + row]; }, pulse, ping, stream, image);
}

}  // namespace ensonify::echo

#include "kernels/acoustics/echo/aperture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "kernels/base/profile/profile.h"

namespace ensonify::echo {

namespace {

/// First samples of arrivals begin..end - 1 of a set.
void find_first(const EchoSet& set, const SampledPulse& pulse, const Sampling& sampling, std::size_t begin,
                std::size_t end, std::int32_t* first) {
  const double* const time_s = set.arrivals.time_s.data();
  const SampledPulse::Grid samples = pulse.grid();
  for (std::size_t i = begin; i < end; ++i)
    first[i - begin] = samples.at((time_s[i] - sampling.start_s) / sampling.period_s).first - sampling.first;
}

/// The same arrivals as a row receives them.
void make_points(const EchoSet& set, std::uint16_t row, const SampledPulse& pulse, const Sampling& sampling,
                 std::size_t begin, std::size_t end, RowPoint* points) {
  const Arrivals& all = set.arrivals;
  const SampledPulse::Grid samples = pulse.grid();
  const float* const gain = set.gain.empty() ? nullptr : set.gain.data() + row * all.size();
  for (std::size_t i = begin; i < end; ++i) {
    const auto at = samples.at((all.time_s[i] - sampling.start_s) / sampling.period_s);
    const float g = gain != nullptr ? gain[i] : 1.0F;
    points[i - begin] = {at.first - sampling.first, static_cast<std::uint16_t>(at.phase), row,
                         g * all.pressure_re_upa[i], g * all.pressure_im_upa[i]};
  }
}

/// Every arrival for each row, in order of rows, and for one in order of sets and arrivals.
void sort(std::span<const EchoSet> echoes, std::size_t rows, const SampledPulse& pulse, const Sampling& sampling,
          RowPoints& points) {
  const std::size_t each = count_arrivals(echoes);
  /// fill(set, row, from, to, where) for points begin..end - 1.
  const auto parts = [&](std::size_t begin, std::size_t end, const auto& fill) {
    for (std::size_t at = begin; at < end;) {
      const std::size_t row = at / each, row_end = std::min(end, (row + 1) * each);
      for_sets(echoes, at - row * each, row_end - row * each,
               [&](std::size_t number, std::size_t from, std::size_t to, std::size_t where) {
                 fill(echoes[number], row, from, to, at - begin + where);
               });
      at = row_end;
    }
  };
  points.set(
      rows * each, pulse, sampling.count,
      [&](std::size_t begin, std::size_t end, std::int32_t* first) {
        parts(begin, end, [&](const EchoSet& set, std::size_t, std::size_t from, std::size_t to, std::size_t where) {
          find_first(set, pulse, sampling, from, to, first + where);
        });
      },
      [&](std::size_t begin, std::size_t end, RowPoint* some) {
        parts(begin, end,
              [&](const EchoSet& set, std::size_t row, std::size_t from, std::size_t to, std::size_t where) {
                make_points(set, static_cast<std::uint16_t>(row), pulse, sampling, from, to, some + where);
              });
      });
}

}  // namespace

void form_apertures(std::span<const EchoSet> echoes, int rows, const SampledPulse& pulse, const Sampling& sampling,
                    RowPoints& points, Image& image) {
  const profile::Span span(profile::Stage::kBeamform);
  for (const EchoSet& set : echoes) {
    if (!set.fits(static_cast<std::size_t>(rows))) {
      throw std::invalid_argument("apertures need one gain per row and arrival, or none");
    }
  }
  sort(echoes, static_cast<std::size_t>(rows), pulse, sampling, points);
  image.resize(rows, sampling.count);
  tbb::parallel_for(0, points.blocks(), [&](int block) {
    const profile::Span part(profile::Stage::kSpread);
    const int first = block * kSamplesPerBlock;
    const int count = std::min(kSamplesPerBlock, sampling.count - first);
    for (int row = 0; row < rows; ++row) std::fill_n(image.row(row).begin() + first, count, std::complex<float>{});
    points.each(block, pulse, [&](const RowPoint& point, int from, std::span<const float> envelope) {
      const std::complex<float> pressure(point.re_upa, point.im_upa);
      std::complex<float>* sample = image.row(point.row).data() + from;
      for (const float e : envelope) *sample++ += e * pressure;
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

#include <algorithm>
#include <array>
#include <bit>
#include <numbers>

#include "kernels/acoustics/detect/beam_series.h"

namespace ensonify::detect {
namespace {

constexpr int kRun = 256;  // samples whose numbers stay in the first cache
constexpr std::size_t kMostForNoise = 256;

/// The number that `rank` others of these do not exceed, none of which is negative: their bits rise as they do. Found
/// bit by bit, which costs a fourth of what a selection with its branches does.
float ranked(const std::array<float, kMostForNoise>& numbers, std::size_t count, std::size_t rank) {
  alignas(64) std::array<std::int32_t, kMostForNoise> bits;
  for (std::size_t i = 0; i < kMostForNoise; ++i) bits[i] = std::bit_cast<std::int32_t>(numbers[i]);
  const auto unused = static_cast<std::int32_t>(kMostForNoise - count);  // numbers of 0 that fill the array
  std::int32_t found = 0;
  for (std::int32_t bit = 1 << 30; bit > 0; bit >>= 1) {
    const std::int32_t more = found | bit;
    std::int32_t below = 0;
    for (std::size_t i = 0; i < kMostForNoise; ++i) below += bits[i] < more ? 1 : 0;
    if (below - unused <= static_cast<std::int32_t>(rank)) found = more;
  }
  return std::bit_cast<float>(found);
}

}  // namespace

double noise_power(const BeamSeries& series) {
  alignas(64) std::array<float, kMostForNoise> some{};
  const int stride = std::max(1, (series.samples() + 255) / 256);
  std::size_t count = 0;
  for (int k = 0; k < series.samples() && count < some.size(); k += stride)
    some[count++] = series.amplitude_upa[static_cast<std::size_t>(k)];
  if (count == 0) return 0.0;
  const auto median = static_cast<double>(ranked(some, count, count / 2));
  return median * median / std::numbers::ln2;
}

Peak strongest(const BeamSeries& series, Interval where) {
  const int pulse = series.samples_per_pulse();
  const float* const amplitude_upa = series.amplitude_upa.data();
  alignas(64) std::array<float, kRun> sum;  // of the powers of the pulse that ends with a sample
  float most = 0.0F;
  int at = -1;
  for (int first = where.first + pulse - 1; first < where.end; first += kRun) {
    const int count = std::min(kRun, where.end - first);
    sum.fill(0.0F);
    for (int back = 0; back < pulse; ++back) {
      const float* const sample = amplitude_upa + first - back;
      for (int i = 0; i < count; ++i) sum[static_cast<std::size_t>(i)] += sample[i] * sample[i];
    }
    alignas(64) std::array<float, 16> lanes{};
    for (std::size_t i = 0; i < kRun; i += lanes.size()) {
      for (std::size_t lane = 0; lane < lanes.size(); ++lane)
        lanes[lane] = sum[i + lane] > lanes[lane] ? sum[i + lane] : lanes[lane];
    }
    const float here = *std::ranges::max_element(lanes);
    if (!(here > most)) continue;
    most = here;
    at = first + static_cast<int>(std::ranges::find(sum, here) - sum.begin());
  }
  if (at < 0) return {};
  return {static_cast<double>(most) / pulse, series.time_s(at) - 0.5 * (pulse - 1) * series.period_s};
}

}  // namespace ensonify::detect

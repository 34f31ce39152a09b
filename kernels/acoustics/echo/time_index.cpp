#include "kernels/acoustics/echo/time_index.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "kernels/acoustics/trace/reserve.h"

namespace ensonify::echo {

void TimeIndex::set(std::span<const Arrival> arrivals, const SampledPulse& pulse, const Sampling& sampling) {
  constexpr std::size_t kPerTask = 8192;
  samples_ = sampling.count;
  blocks_ = (samples_ + kBlock - 1) / kBlock;
  reach_ = (pulse.support() + kBlock - 2) / kBlock;
  trace::make_elements(received_, arrivals.size());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, arrivals.size(), kPerTask),
      [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const auto place = pulse.place((arrivals[i].time_s - sampling.start_s) / sampling.period_s);
          received_[i] = {place.first, static_cast<std::uint32_t>(place.phase), static_cast<std::uint32_t>(i)};
        }
      },
      tbb::simple_partitioner());
  by_block_.sort(received_, static_cast<std::size_t>(blocks_), [&](const Received& received) {
    const bool outside = received.first >= samples_ || received.first + pulse.support() <= 0;
    return static_cast<std::size_t>(outside ? blocks_ : std::max(received.first, 0) / kBlock);
  });
}

bool TimeIndex::any(int block) const {
  for (int b = first_block(block); b <= block; ++b) {
    if (!by_block_.bucket(static_cast<std::size_t>(b)).empty()) return true;
  }
  return false;
}

}  // namespace ensonify::echo

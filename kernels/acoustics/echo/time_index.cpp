#include "kernels/acoustics/echo/time_index.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "kernels/acoustics/trace/batch.h"

namespace ensonify::echo {

void TimeIndex::set(std::span<const EchoSet> echoes, const SampledPulse& pulse, const Sampling& sampling) {
  constexpr std::size_t kPerTask = 8192;
  samples_ = sampling.count;
  blocks_ = (samples_ + kBlock - 1) / kBlock;
  reach_ = (pulse.support() + kBlock - 2) / kBlock;
  std::size_t all = 0;
  for (const EchoSet& set : echoes) all += set.arrivals.size();
  trace::make_elements(received_, all);
  Received* received = received_.data();
  for (std::uint16_t number = 0; number < echoes.size(); ++number) {
    const Arrivals& arrivals = echoes[number].arrivals;
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, arrivals.size(), kPerTask),
        [&](const auto& range) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const auto place = pulse.place((arrivals.time_s[i] - sampling.start_s) / sampling.period_s);
            received[i] = {place.first, static_cast<std::uint16_t>(place.phase), number, static_cast<std::uint32_t>(i)};
          }
        },
        tbb::simple_partitioner());
    received += arrivals.size();
  }
  by_block_.sort(received_, static_cast<std::size_t>(blocks_), [&](const Received& one) {
    const bool outside = one.first >= samples_ || one.first + pulse.support() <= 0;
    return static_cast<std::size_t>(outside ? blocks_ : std::max(one.first, 0) / kBlock);
  });
}

bool TimeIndex::any(int block) const {
  for (int b = first_block(block); b <= block; ++b) {
    if (!by_block_.bucket(static_cast<std::size_t>(b)).empty()) return true;
  }
  return false;
}

}  // namespace ensonify::echo

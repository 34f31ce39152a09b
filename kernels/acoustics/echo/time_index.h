#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/acoustics/echo/arrival.h"
#include "kernels/acoustics/echo/image.h"
#include "kernels/acoustics/echo/partition.h"
#include "kernels/acoustics/echo/pulse.h"

namespace ensonify::echo {

/// Which arrivals are heard when: blocks of samples that can be summed apart, each in a fixed order.
class TimeIndex {
 public:
  static constexpr int kBlock = 32;  // samples

  struct Heard {
    std::int32_t first;  // sample; may lie before 0
    std::uint32_t phase;
    std::uint32_t arrival;
  };

  void set(std::span<const Arrival> arrivals, const SampledPulse& pulse, const Sampling& sampling);

  int blocks() const { return blocks_; }

  /// Whether anything is heard in this block.
  bool any(int block) const;

  /// Calls add(arrival index, first sample, envelope of samples from there) for what is heard in a block, cut to the
  /// block.
  template <class Add>
  void each(int block, const SampledPulse& pulse, const Add& add) const {
    const int begin = block * kBlock, end = std::min(begin + kBlock, samples_);
    for (int b = first_block(block); b <= block; ++b) {
      for (const Heard& heard : by_block_.bucket(static_cast<std::size_t>(b))) {
        const int from = std::max(heard.first, begin), to = std::min(heard.first + pulse.support(), end);
        if (from >= to) continue;
        add(heard.arrival, from,
            pulse.row(static_cast<int>(heard.phase))
                .subspan(static_cast<std::size_t>(from - heard.first), static_cast<std::size_t>(to - from)));
      }
    }
  }

 private:
  int first_block(int block) const { return std::max(0, block - reach_); }

  int samples_ = 0, blocks_ = 0;
  int reach_ = 0;  // how many blocks before it an arrival may have begun
  std::vector<Heard> heard_;
  Partition<Heard> by_block_;
};

}  // namespace ensonify::echo

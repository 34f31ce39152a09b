#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/acoustics/echo/arrival.h"
#include "kernels/acoustics/echo/image.h"
#include "kernels/acoustics/echo/partition.h"
#include "kernels/acoustics/echo/pulse.h"

namespace ensonify::echo {

/// Which arrivals are received when: blocks of samples that can be summed apart, each in a fixed order.
class TimeIndex {
 public:
  static constexpr int kBlock = 32;  // samples

  struct Received {
    std::int32_t first;  // sample; may lie before 0
    std::uint16_t phase, set;
    std::uint32_t arrival;  // of its set
  };

  /// In order of sets, and within each of arrivals.
  void set(std::span<const EchoSet> echoes, const SampledPulse& pulse, const Sampling& sampling);

  int blocks() const { return blocks_; }

  /// Whether anything is received in this block.
  bool any(int block) const;

  /// Calls add(set, arrival, first sample, envelope of samples from there) for what is received in a block, cut to the
  /// block.
  template <class Add>
  void each(int block, const SampledPulse& pulse, const Add& add) const {
    const int begin = block * kBlock, end = std::min(begin + kBlock, samples_);
    for (int b = first_block(block); b <= block; ++b) {
      for (const Received& received : by_block_.bucket(static_cast<std::size_t>(b))) {
        const int from = std::max(received.first, begin), to = std::min(received.first + pulse.support(), end);
        if (from >= to) continue;
        add(received.set, received.arrival, from,
            pulse.row(static_cast<int>(received.phase))
                .subspan(static_cast<std::size_t>(from - received.first), static_cast<std::size_t>(to - from)));
      }
    }
  }

 private:
  int first_block(int block) const { return std::max(0, block - reach_); }

  int samples_ = 0, blocks_ = 0;
  int reach_ = 0;  // how many blocks before it an arrival may have begun
  std::vector<Received> received_;
  Partition<Received> by_block_;
};

}  // namespace ensonify::echo

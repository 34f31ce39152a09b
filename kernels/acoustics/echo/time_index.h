#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/acoustics/echo/arrival.h"
#include "kernels/acoustics/echo/partition.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/acoustics/trace/batch.h"

namespace ensonify::echo {

/// Which of many rows are received when: blocks of samples that can be summed apart, each in a fixed order. A row has
/// its `first` sample, which may lie before 0, and its `phase` between two samples (SampledPulse::Place).
template <class Row>
class ByTime {
 public:
  static constexpr int kBlock = 32;  // samples

  /// Of so many rows, those that reach any of the samples. fill(begin, end, rows) writes rows begin..end - 1, from
  /// several threads.
  template <class Fill>
  void set(std::size_t count, const SampledPulse& pulse, int samples, const Fill& fill) {
    constexpr std::size_t kRowsPerTask = 8192;
    samples_ = samples;
    blocks_ = (samples + kBlock - 1) / kBlock;
    reach_ = (pulse.support() + kBlock - 2) / kBlock;
    trace::make_elements(rows_, count);
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, kRowsPerTask),
        [&](const auto& range) { fill(range.begin(), range.end(), rows_.data() + range.begin()); },
        tbb::simple_partitioner());
    by_block_.sort(rows_, static_cast<std::size_t>(blocks_), [&](const Row& row) {
      const bool outside = row.first >= samples || row.first + pulse.support() <= 0;
      return static_cast<std::size_t>(outside ? blocks_ : std::max(row.first, 0) / kBlock);
    });
  }

  int blocks() const { return blocks_; }

  /// Whether anything is received in this block.
  bool any(int block) const {
    for (int b = first_block(block); b <= block; ++b) {
      if (!by_block_.bucket(static_cast<std::size_t>(b)).empty()) return true;
    }
    return false;
  }

  /// Calls add(row, first sample, envelope of samples from there) for what is received in a block, cut to the block.
  template <class Add>
  void each(int block, const SampledPulse& pulse, const Add& add) const {
    const int begin = block * kBlock, end = std::min(begin + kBlock, samples_);
    for (int b = first_block(block); b <= block; ++b) {
      for (const Row& row : by_block_.bucket(static_cast<std::size_t>(b))) {
        const int from = std::max(row.first, begin), to = std::min(row.first + pulse.support(), end);
        if (from >= to) continue;
        add(row, from,
            pulse.row(row.phase).subspan(static_cast<std::size_t>(from - row.first),
                                         static_cast<std::size_t>(to - from)));
      }
    }
  }

 private:
  int first_block(int block) const { return std::max(0, block - reach_); }

  int samples_ = 0, blocks_ = 0;
  int reach_ = 0;  // how many blocks before it a row may have begun
  std::vector<Row> rows_;
  Partition<Row> by_block_;
};

/// Arrivals by time.
struct Received {
  std::int32_t first;
  std::uint16_t phase, set;
  std::uint32_t arrival;  // of its set
};
class TimeIndex : public ByTime<Received> {
 public:
  /// In order of sets, and within each of arrivals.
  void set(std::span<const EchoSet> echoes, const SampledPulse& pulse, const Sampling& sampling);
};

/// Calls fill(set, begin, end, row) for the parts of sets that lie in begin..end - 1 of all of their arrivals.
template <class Fill>
void for_sets(std::span<const EchoSet> echoes, std::size_t begin, std::size_t end, const Fill& fill) {
  std::size_t before = 0;
  for (std::size_t number = 0; number < echoes.size(); ++number) {
    const std::size_t size = echoes[number].arrivals.size();
    const std::size_t from = std::max(begin, before), to = std::min(end, before + size);
    if (from < to) fill(number, from - before, to - before, from - begin);
    before += size;
  }
}

/// Arrivals of all sets together.
inline std::size_t count_arrivals(std::span<const EchoSet> echoes) {
  std::size_t count = 0;
  for (const EchoSet& set : echoes) count += set.arrivals.size();
  return count;
}

}  // namespace ensonify::echo

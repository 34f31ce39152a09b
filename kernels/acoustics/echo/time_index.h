#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/acoustics/echo/arrival.h"
#include "kernels/acoustics/echo/partition.h"
#include "kernels/acoustics/echo/pulse.h"

namespace ensonify::echo {

/// Which of many rows are received when: blocks of samples that can be summed apart, each in a fixed order. A row has
/// its `first` sample, which may lie before 0, and its `phase` between two samples (SampledPulse::Place).
template <class Row>
class ByTime {
 public:
  static constexpr int kBlock = 32;         // samples
  static constexpr std::size_t kRun = 256;  // rows that stay in the first cache

  /// Of so many rows, those that reach any of the samples, in their order. first_of(begin, end, first) writes the first
  /// samples of rows begin..end - 1, fill(begin, end, rows) the rows: kRun at most, from several threads. Two passes,
  /// so that memory is written once, and only for rows that are kept.
  template <class FirstOf, class Fill>
  void set(std::size_t count, const SampledPulse& pulse, int samples, const FirstOf& first_of, const Fill& fill) {
    samples_ = samples;
    blocks_ = (samples + kBlock - 1) / kBlock;
    reach_ = (pulse.support() + kBlock - 2) / kBlock;
    const int support = pulse.support();
    const auto bucket_of = [=, this](std::int32_t first) {
      const bool outside = first >= samples || first + support <= 0;
      return static_cast<std::size_t>(outside ? blocks_ : std::max(first, 0) / kBlock);
    };
    by_block_.count(count, static_cast<std::size_t>(blocks_), [&](std::size_t begin, std::size_t end, auto add) {
      std::array<std::int32_t, kRun> first;
      for (; begin < end; begin += kRun) {
        const std::size_t size = std::min(kRun, end - begin);
        first_of(begin, begin + size, first.data());
        for (std::size_t i = 0; i < size; ++i) add(bucket_of(first[i]));
      }
    });
    by_block_.fill([&](std::size_t begin, std::size_t end, auto add) {
      std::array<Row, kRun> rows;
      for (; begin < end; begin += kRun) {
        const std::size_t size = std::min(kRun, end - begin);
        fill(begin, begin + size, rows.data());
        for (std::size_t i = 0; i < size; ++i) add(bucket_of(rows[i].first), rows[i]);
      }
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

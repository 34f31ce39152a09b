#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/acoustics/trace/batch.h"

namespace ensonify::echo {

/// Puts items into buckets in parallel; items of a bucket keep their order, so the result is the same for any number of
/// threads. Memory is kept for the next call.
template <class Item>
class Partition {
 public:
  /// bucket_of(item) in 0..buckets-1, or any larger number for an item to leave out.
  template <class BucketOf>
  void sort(std::span<const Item> items, std::size_t buckets, const BucketOf& bucket_of) {
    constexpr std::size_t kChunk = 8192;
    const std::size_t chunks = (items.size() + kChunk - 1) / kChunk;
    const auto each_chunk = [&](const auto& what) {
      tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
        std::uint32_t* place = places_.data() + chunk * buckets;
        const std::size_t end = std::min(items.size(), (chunk + 1) * kChunk);
        for (std::size_t i = chunk * kChunk; i < end; ++i) {
          const std::size_t bucket = bucket_of(items[i]);
          if (bucket < buckets) what(items[i], place[bucket]);
        }
      });
    };
    places_.assign(chunks * buckets, 0);
    each_chunk([](const Item&, std::uint32_t& count) { ++count; });
    start_.resize(buckets + 1);
    std::uint32_t next = 0;
    for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
      start_[bucket] = next;
      for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        const std::uint32_t count = places_[chunk * buckets + bucket];
        places_[chunk * buckets + bucket] = next;
        next += count;
      }
    }
    start_[buckets] = next;
    trace::make_elements(items_, next);
    each_chunk([&](const Item& item, std::uint32_t& place) { items_[place++] = item; });
  }

  std::span<Item> bucket(std::size_t i) { return std::span(items_).subspan(start_[i], start_[i + 1] - start_[i]); }
  std::span<const Item> bucket(std::size_t i) const {
    return std::span(items_).subspan(start_[i], start_[i + 1] - start_[i]);
  }
  std::size_t largest() const {
    std::uint32_t most = 0;
    for (std::size_t i = 0; i + 1 < start_.size(); ++i) most = std::max(most, start_[i + 1] - start_[i]);
    return most;
  }

 private:
  std::vector<std::uint32_t> places_;  // chunk by bucket: count, then where the next item goes
  std::vector<std::uint32_t> start_;
  std::vector<Item> items_;
};

}  // namespace ensonify::echo

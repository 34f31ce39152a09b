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
    count(items.size(), buckets, [&](std::size_t begin, std::size_t end, auto add) {
      for (std::size_t i = begin; i < end; ++i) add(bucket_of(items[i]));
    });
    fill([&](std::size_t begin, std::size_t end, auto add) {
      for (std::size_t i = begin; i < end; ++i) add(bucket_of(items[i]), items[i]);
    });
  }

  /// The same for items that are in no array: first where each will go, then the items. each(begin, end, add) calls
  /// add(bucket) or add(bucket, item) for items begin..end - 1 in their order.
  template <class Each>
  void count(std::size_t items, std::size_t buckets, const Each& each) {
    count_ = items;
    buckets_ = buckets;
    const std::size_t chunks = (items + kChunk - 1) / kChunk;
    places_.assign(chunks * buckets, 0);
    each_chunk(each, [buckets](std::uint32_t* place) {
      return [place, buckets](std::size_t bucket) {
        if (bucket < buckets) ++place[bucket];
      };
    });
    start_.resize(buckets + 1);
    std::uint32_t next = 0;
    for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
      start_[bucket] = next;
      for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        const std::uint32_t size = places_[chunk * buckets + bucket];
        places_[chunk * buckets + bucket] = next;
        next += size;
      }
    }
    start_[buckets] = next;
    trace::make_elements(items_, next);
  }
  template <class Each>
  void fill(const Each& each) {
    each_chunk(each, [this](std::uint32_t* place) {
      return [this, place](std::size_t bucket, const Item& item) {
        if (bucket < buckets_) items_[place[bucket]++] = item;
      };
    });
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
  static constexpr std::size_t kChunk = 8192;

  template <class Each, class AddTo>
  void each_chunk(const Each& each, const AddTo& add_to) {
    tbb::parallel_for(std::size_t{0}, (count_ + kChunk - 1) / kChunk, [&](std::size_t chunk) {
      each(chunk * kChunk, std::min(count_, (chunk + 1) * kChunk), add_to(places_.data() + chunk * buckets_));
    });
  }

  std::size_t count_ = 0, buckets_ = 0;
  std::vector<std::uint32_t> places_;  // chunk by bucket: count, then where the next item goes
  std::vector<std::uint32_t> start_;
  std::vector<Item> items_;
};

}  // namespace ensonify::echo

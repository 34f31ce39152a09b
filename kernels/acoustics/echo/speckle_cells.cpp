#include "kernels/acoustics/echo/speckle_cells.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace ensonify::echo {
namespace {

/// Blocks of 16 cells each way go to one bucket, so that the hits of a bucket stand together in memory.
constexpr std::uint64_t kBlock =
    ~(std::uint64_t{15} | (std::uint64_t{15} << kCellBits) | (std::uint64_t{15} << (2 * kCellBits)));
/// Blocks of 4 cells each way, whose slots in a table are one line of the cache.
constexpr std::uint64_t kPatch =
    ~(std::uint64_t{3} | (std::uint64_t{3} << kCellBits) | (std::uint64_t{3} << (2 * kCellBits)));
constexpr std::size_t kLine = 16, kLeastTable = 64;

/// The top bits are well mixed.
std::uint64_t spread(std::uint64_t cell) { return cell * 0x9e3779b97f4a7c15ULL; }

/// Where a search for a cell begins in a table whose size is a power of 2. Of a layer of a patch, whichever way it
/// stands, all 16 cells begin in different slots of one line.
std::size_t slot_of(std::uint64_t cell, std::size_t table_size) {
  const std::uint64_t up = cell >> (2 * kCellBits);
  const std::uint64_t in_line = ((cell + up) & 3) | (((cell >> kCellBits) + up) & 3) << 2;
  return (((spread(cell & kPatch) >> 40) * kLine) & (table_size - 1)) | in_line;
}

/// The next slot: another of the next line, and in the end every one.
std::size_t after(std::size_t slot, std::size_t table_size) { return (slot + kLine + 1) & (table_size - 1); }

}  // namespace

/// The next ping may have some more: no memory for them then.
void SpeckleCells::Accumulator::clear() {
  for (Bucket& bucket : buckets_) {
    const std::size_t size = bucket.entries.size();
    bucket.entries.clear();
    bucket.numbered = 0;
    if (bucket.entries.capacity() < size + size / 2) bucket.entries.reserve(2 * size);
  }
  const std::size_t size = found_.size();
  found_.clear();
  found_.make_room(size + size / 8);
}

SpeckleCells::SpeckleCells(double cell_m, const CellStreams& streams) : cell_m_(cell_m), streams_(streams) {
  if (!(cell_m > 0.0)) throw std::invalid_argument("the cells of scatterers must have a size above 0 m");
}

void SpeckleCells::add(const Insonification& batch, Accumulator& sum) const {
  const auto bucket_of = [](std::uint64_t cell) {
    return cell == kNoCell ? kBuckets : static_cast<std::size_t>(spread(cell & kBlock) >> 56);
  };
  const auto each_run = [](std::size_t begin, std::size_t end, auto& run, const auto& work) {
    for (; begin < end; begin += kCellRun) work(begin, std::span(run).first(std::min(kCellRun, end - begin)));
  };
  sum.by_bucket_.count(batch.hits.size(), kBuckets, [&](std::size_t begin, std::size_t end, const auto& add) {
    std::array<std::uint64_t, kCellRun> cells;
    each_run(begin, end, cells, [&](std::size_t first, const auto& run) {
      find_cells(batch.hits, cell_m_, first, run);
      for (const std::uint64_t cell : run) add(bucket_of(cell));
    });
  });
  sum.by_bucket_.fill([&](std::size_t begin, std::size_t end, const auto& add) {
    std::array<CellHit, kCellRun> hits;
    each_run(begin, end, hits, [&](std::size_t first, const auto& run) {
      find_cells(batch, cell_m_, first, run);
      for (const CellHit& hit : run) add(bucket_of(hit.cell), hit);
    });
  });
  sum.number_.assign(batch.hits.size(), 0);
  tbb::parallel_for(std::size_t{0}, kBuckets, [&](std::size_t bucket) {
    merge(std::as_const(sum.by_bucket_).bucket(bucket), sum.buckets_[bucket], sum.number_);
  });
  find_new(batch, sum);
  tbb::parallel_for(std::size_t{0}, kBuckets,
                    [&](std::size_t bucket) { number_new(sum.number_, sum.buckets_[bucket], sum.found_); });
}

/// Adds rays to the entries of their cells and contributors, which are made when they are first found.
void SpeckleCells::merge(std::span<const CellHit> hits, Bucket& bucket, std::span<std::uint32_t> makes) {
  if (hits.empty()) return;
  auto& [entries, table, numbered] = bucket;
  if (table.empty()) table.resize(kLeastTable);
  if (entries.empty()) std::ranges::fill(table, -1);  // not before: the cache has it now
  for (const CellHit& hit : hits) {
    if (2 * (entries.size() + 1) > table.size()) grow(bucket);
    std::size_t slot = slot_of(hit.cell, table.size());
    while (table[slot] >= 0 && entries[static_cast<std::size_t>(table[slot])].cell != hit.cell)
      slot = after(slot, table.size());
    const auto number = static_cast<std::int32_t>(entries.size());
    const std::int32_t first = table[slot] >= 0 ? table[slot] : number;
    std::int32_t* link = &table[slot];  // to the entry of this contributor
    while (*link >= 0 && entries[static_cast<std::size_t>(*link)].contributor != hit.contributor)
      link = &entries[static_cast<std::size_t>(*link)].next;
    if (*link >= 0) {
      Entry& same = entries[static_cast<std::size_t>(*link)];
      same.scattered_upa2m2 += hit.scattered_upa2m2;
      same.cross_section_m2 += hit.cross_section_m2;
      continue;
    }
    *link = number;
    entries.push_back({hit.cell, hit.scattered_upa2m2, hit.cross_section_m2, hit.contributor, hit.ray, first, -1});
    makes[hit.ray] = 1;
  }
}

/// Numbers the scatterers that rays of this batch make, in the order of rays, and finds where they are.
void SpeckleCells::find_new(const Insonification& batch, Accumulator& sum) const {
  auto &number = sum.number_, &makers = sum.makers_;
  const std::size_t before = sum.found_.size();
  trace::make_elements(makers, number.size() + 1);
  std::uint32_t count = 0;
  for (std::uint32_t ray = 0; ray < number.size(); ++ray) {
    const std::uint32_t makes = number[ray];
    makers[count] = ray;
    number[ray] = static_cast<std::uint32_t>(before) + count;
    count += makes;
  }
  sum.found_.resize(before + count);
  tbb::parallel_for(std::size_t{0}, (count + kCellRun - 1) / kCellRun, [&](std::size_t run) {
    const std::size_t first = run * kCellRun;
    const auto rays = std::span(makers).subspan(first, std::min(kCellRun, count - first));
    find_geometry(batch, cell_m_, streams_, rays, sum.found_, before + first);
  });
}

/// Gives new entries their scatterers' numbers. Those of one cell share the place and the response of its first.
void SpeckleCells::number_new(std::span<const std::uint32_t> number, Bucket& bucket, Scatterers& found) {
  auto& [entries, table, numbered] = bucket;
  for (; numbered < entries.size(); ++numbered) {
    Entry& entry = entries[numbered];
    entry.scatterer = number[entry.scatterer];
    const auto first = static_cast<std::size_t>(entry.first);
    if (first != numbered) found.set(entry.scatterer, found[entries[first].scatterer]);
  }
}

void SpeckleCells::grow(Bucket& bucket) {
  const auto& entries = bucket.entries;
  auto& table = bucket.table;
  table.assign(2 * table.size(), -1);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (static_cast<std::size_t>(entries[i].first) != i) continue;
    std::size_t slot = slot_of(entries[i].cell, table.size());
    while (table[slot] >= 0) slot = after(slot, table.size());
    table[slot] = static_cast<std::int32_t>(i);
  }
}

/// Of all cells: a cell's contributors share what it scatters as their energies are.
void SpeckleCells::take_energies(const Bucket& bucket, Scatterers& found) {
  const auto& entries = bucket.entries;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (static_cast<std::size_t>(entries[i].first) != i) continue;
    float scattered_upa2m2 = 0.0F, cross_section_m2 = 0.0F;
    const auto each = [&](const auto& visit) {
      for (const Entry* entry = &entries[i];; entry = &entries[static_cast<std::size_t>(entry->next)]) {
        visit(*entry);
        if (entry->next < 0) return;
      }
    };
    each([&](const Entry& entry) {
      scattered_upa2m2 += entry.scattered_upa2m2;
      cross_section_m2 += entry.cross_section_m2;
    });
    each([&](const Entry& entry) {
      const std::size_t k = entry.scatterer;
      found.scattered_upa2m2[k] = scattered_upa2m2;
      found.cross_section_m2[k] = cross_section_m2;
      found.share[k] = scattered_upa2m2 > 0.0F ? entry.scattered_upa2m2 / scattered_upa2m2 : 1.0F;
      found.contributor[k] = entry.contributor;
    });
  }
}

const Scatterers& SpeckleCells::gather(Accumulator& sum, const Scatterers& more) {
  tbb::parallel_for(std::size_t{0}, kBuckets,
                    [&](std::size_t bucket) { take_energies(sum.buckets_[bucket], sum.found_); });
  const std::size_t own = sum.found_.size();
  sum.found_.resize(own + more.size());
  for (std::size_t i = 0; i < more.size(); ++i) sum.found_.set(own + i, more[i]);
  return sum.found_;
}

}  // namespace ensonify::echo

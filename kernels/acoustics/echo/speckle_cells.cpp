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

void SpeckleCells::Bucket::reserve(std::size_t size) {
  entries.reserve(size);
  geometry.reserve(size);
  rays.reserve(size);
}

void SpeckleCells::Accumulator::clear() {
  for (Bucket& bucket : buckets_) {
    // The next ping may have some more: no memory for them then.
    const std::size_t size = bucket.entries.size();
    bucket.entries.clear();
    bucket.geometry.clear();
    if (bucket.entries.capacity() < size + size / 2) bucket.reserve(2 * size);
    std::ranges::fill(bucket.table, -1);
  }
}

SpeckleCells::SpeckleCells(double cell_m, const random::Stream& stream) : cell_m_(cell_m), stream_(stream) {
  if (!(cell_m > 0.0)) throw std::invalid_argument("the cells of scatterers must have a size above 0 m");
}

void SpeckleCells::add(const Insonification& batch, Accumulator& sum) const {
  const auto each_run = [&](std::size_t begin, std::size_t end, const auto& work) {
    std::array<CellHit, kCellRun> hits;
    for (; begin < end; begin += kCellRun) {
      const auto run = std::span(hits).first(std::min(kCellRun, end - begin));
      find_cells(batch, cell_m_, begin, run);
      for (const CellHit& hit : run) work(hit);
    }
  };
  const auto bucket_of = [](const CellHit& hit) {
    return hit.cell == kNoCell ? kBuckets : static_cast<std::size_t>(spread(hit.cell & kBlock) >> 56);
  };
  sum.by_bucket_.count(batch.hits.size(), kBuckets, [&](std::size_t begin, std::size_t end, const auto& add) {
    each_run(begin, end, [&](const CellHit& hit) { add(bucket_of(hit)); });
  });
  sum.by_bucket_.fill([&](std::size_t begin, std::size_t end, const auto& add) {
    each_run(begin, end, [&](const CellHit& hit) { add(bucket_of(hit), hit); });
  });
  tbb::parallel_for(std::size_t{0}, kBuckets, [&](std::size_t bucket) {
    merge(batch, std::as_const(sum.by_bucket_).bucket(bucket), sum.buckets_[bucket]);
  });
}

/// Adds rays to the entries of their cells and contributors, which are made when they are first found.
void SpeckleCells::merge(const Insonification& batch, std::span<const CellHit> hits, Bucket& bucket) const {
  auto& [entries, geometry, table, rays] = bucket;
  const std::size_t before = entries.size();
  rays.clear();
  for (const CellHit& hit : hits) {
    if (2 * (entries.size() + 1) > table.size()) grow(bucket);
    std::size_t slot = slot_of(hit.cell, table.size());
    while (table[slot] >= 0 && entries[static_cast<std::size_t>(table[slot])].cell != hit.cell)
      slot = after(slot, table.size());
    const auto number = static_cast<std::int32_t>(entries.size());
    if (table[slot] < 0) {
      table[slot] = number;
      entries.push_back(
          {hit.cell, hit.scattered_upa2m2, hit.cross_section_m2, hit.scattered_upa2m2, hit.contributor, number, -1});
      rays.push_back(hit.ray);
      continue;
    }
    Entry& cell = entries[static_cast<std::size_t>(table[slot])];
    cell.scattered_upa2m2 += hit.scattered_upa2m2;
    cell.cross_section_m2 += hit.cross_section_m2;
    Entry* same = &cell;
    while (same->contributor != hit.contributor && same->next >= 0)
      same = &entries[static_cast<std::size_t>(same->next)];
    if (same->contributor == hit.contributor) {
      same->own_upa2m2 += hit.scattered_upa2m2;
    } else {
      same->next = number;
      entries.push_back({hit.cell, 0.0F, 0.0F, hit.scattered_upa2m2, hit.contributor, table[slot], -1});
      rays.push_back(hit.ray);
    }
  }
  find_new(batch, before, bucket);
}

/// Geometry of entries from `begin` on: of a cell's first by its ray, of the others that of the first.
void SpeckleCells::find_new(const Insonification& batch, std::size_t begin, Bucket& bucket) const {
  auto& [entries, geometry, table, rays] = bucket;
  geometry.resize(entries.size());
  std::array<std::uint64_t, kCellRun> cells;
  for (std::size_t done = begin; done < entries.size(); done += kCellRun) {
    const std::size_t count = std::min(kCellRun, entries.size() - done);
    for (std::size_t i = 0; i < count; ++i) cells[i] = entries[done + i].cell;
    find_geometry(batch, cell_m_, stream_, std::span(cells).first(count), std::span(rays).subspan(done - begin, count),
                  geometry.data() + done);
  }
  for (std::size_t i = begin; i < entries.size(); ++i)
    geometry[i] = geometry[static_cast<std::size_t>(entries[i].first)];
}

void SpeckleCells::grow(Bucket& bucket) {
  const auto& entries = bucket.entries;
  auto& table = bucket.table;
  table.assign(std::max(kLeastTable, 2 * table.size()), -1);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (static_cast<std::size_t>(entries[i].first) != i) continue;
    std::size_t slot = slot_of(entries[i].cell, table.size());
    while (table[slot] >= 0) slot = after(slot, table.size());
    table[slot] = static_cast<std::int32_t>(i);
  }
}

void SpeckleCells::gather(Accumulator& sum, Scatterers& found) {
  auto& start = sum.start_;
  start.assign(1, 0);
  for (const Bucket& bucket : sum.buckets_) start.push_back(start.back() + bucket.entries.size());
  found.make_elements(start.back());
  tbb::parallel_for(std::size_t{0}, kBuckets, [&](std::size_t number) {
    const auto& [entries, geometry, table, rays] = sum.buckets_[number];
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const Entry& own = entries[i];
      const Entry& cell = entries[static_cast<std::size_t>(own.first)];  // of all of its contributors
      const CellGeometry& at = geometry[i];
      Scatterer one{at.position_enu_m,
                    at.bend_enu,
                    at.slowness_spm,
                    at.stretch,
                    at.spreading,
                    cell.scattered_upa2m2,
                    cell.cross_section_m2,
                    {at.response_re, at.response_im},
                    1.0F,
                    own.contributor};
      if (cell.next >= 0 && one.scattered_upa2m2 > 0.0F) one.share = own.own_upa2m2 / one.scattered_upa2m2;
      found.set(start[number] + i, one);
    }
  });
}

}  // namespace ensonify::echo

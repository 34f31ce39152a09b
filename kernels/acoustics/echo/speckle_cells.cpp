#include "kernels/acoustics/echo/speckle_cells.h"

#include <tbb/blocked_range.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ensonify::echo {
namespace {

using frames::Vec3;

constexpr std::size_t kRaysPerTask = 4096;
constexpr std::uint64_t kNothing = ~std::uint64_t{0};  // no cell has this number: cells use 63 bits
constexpr int kBits = 21;
constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;
/// Blocks of 16 cells each way go to one bucket, so that the hits of a bucket stand together in memory.
constexpr std::uint64_t kBlock =
    ~(std::uint64_t{15} | (std::uint64_t{15} << kBits) | (std::uint64_t{15} << (2 * kBits)));

/// The top bits are well mixed.
std::uint64_t spread(std::uint64_t cell) { return cell * 0x9e3779b97f4a7c15ULL; }
/// Where a search for a cell begins in a table whose size is a power of 2.
std::size_t slot_of(std::uint64_t cell, std::size_t table_size) { return (spread(cell) >> 40) & (table_size - 1); }
/// A flat seabed at a round depth must not lie on the border of two layers of cells.
const Vec3 kShift(0.3819660113, 0.6180339887, 0.2360679775);

/// A complex Gaussian of mean square 1 from 64 random bits (Box and Muller [BoxMuller1958]).
std::complex<float> gaussian(std::uint32_t radius, std::uint32_t turn) {
  const float u = (static_cast<float>(radius >> 8) + 0.5F) * 0x1p-24F;
  const float angle = static_cast<float>(turn) * (std::numbers::pi_v<float> * 0x1p-31F);
  const float r = std::sqrt(-std::log(u));
  return {r * std::cos(angle), r * std::sin(angle)};
}

}  // namespace

void SpeckleCells::Accumulator::clear() {
  for (Bucket& bucket : buckets_) {
    // The next ping may have some more: no memory for them then.
    if (const std::size_t size = bucket.entries.size(); bucket.entries.capacity() < size + size / 2) {
      bucket.entries.clear();
      bucket.entries.reserve(2 * size);
    }
    bucket.entries.clear();
    std::ranges::fill(bucket.table, -1);
  }
}

SpeckleCells::SpeckleCells(double cell_m, const random::Stream& stream)
    : cell_m_(cell_m), per_cell_(1.0 / cell_m), stream_(stream) {
  if (!(cell_m > 0.0)) throw std::invalid_argument("the cells of scatterers must have a size above 0 m");
}

std::uint64_t SpeckleCells::cell_at(const Vec3& position_enu_m) const {
  const Vec3 cell = position_enu_m * per_cell_ + kShift;
  const auto index = [](double x) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x))) & kMask;
  };
  return index(cell.x()) | (index(cell.y()) << kBits) | (index(cell.z()) << (2 * kBits));
}

SpeckleCells::Insonified SpeckleCells::insonified_by(const Insonification& batch, std::size_t ray) const {
  const trace::Hits& hits = batch.hits;
  if (!hits.hit(ray)) return {kNothing, 0, 0, 0.0F, 0.0F};
  const float sigma_solid =
      batch.backscatter[ray] * batch.rays.solid_angle_sr[ray] / std::max(hits.sin_grazing[ray], 1e-3F);
  return {cell_at(hits.position_enu_m[ray]), static_cast<std::uint32_t>(ray), hits.contributor[ray],
          batch.source_upa2m2[ray] * sigma_solid, hits.tube_m2[ray] * sigma_solid};
}

void SpeckleCells::add(const Insonification& batch, Accumulator& sum) const {
  auto& insonified = sum.insonified_;
  trace::make_elements(insonified, batch.hits.size());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, insonified.size(), kRaysPerTask),
      [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) insonified[i] = insonified_by(batch, i);
      },
      tbb::simple_partitioner());
  sum.by_bucket_.sort(insonified, kBuckets, [](const Insonified& one) {
    return one.cell == kNothing ? kBuckets : static_cast<std::size_t>(spread(one.cell & kBlock) >> 56);
  });
  tbb::parallel_for(std::size_t{0}, kBuckets, [&](std::size_t bucket) {
    merge(batch, std::as_const(sum.by_bucket_).bucket(bucket), sum.buckets_[bucket]);
  });
}

/// Adds rays to the entries of their cells and contributors, which are made when they are first found.
void SpeckleCells::merge(const Insonification& batch, std::span<const Insonified> insonified, Bucket& bucket) const {
  auto& [entries, table] = bucket;
  for (const Insonified& one : insonified) {
    if (2 * (entries.size() + 1) > table.size()) grow(bucket);
    std::size_t slot = slot_of(one.cell, table.size());
    while (table[slot] >= 0 && entries[static_cast<std::size_t>(table[slot])].cell != one.cell)
      slot = (slot + 1) & (table.size() - 1);
    const auto number = static_cast<std::int32_t>(entries.size());
    if (table[slot] < 0) {
      table[slot] = number;
      entries.push_back({one.cell, one.scattered_upa2m2, number, -1, scatterer(batch, one)});
      continue;
    }
    Entry& cell = entries[static_cast<std::size_t>(table[slot])];
    cell.scatterer.scattered_upa2m2 += one.scattered_upa2m2;
    cell.scatterer.cross_section_m2 += one.cross_section_m2;
    Entry* same = &cell;
    while (same->scatterer.contributor != one.contributor && same->next >= 0)
      same = &entries[static_cast<std::size_t>(same->next)];
    if (same->scatterer.contributor == one.contributor) {
      same->own_upa2m2 += one.scattered_upa2m2;
    } else {
      same->next = number;
      Entry other{one.cell, one.scattered_upa2m2, table[slot], -1, cell.scatterer};
      other.scatterer.contributor = one.contributor;
      entries.push_back(other);
    }
  }
}

void SpeckleCells::grow(Bucket& bucket) {
  auto& [entries, table] = bucket;
  table.assign(std::max<std::size_t>(64, 2 * table.size()), -1);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (static_cast<std::size_t>(entries[i].first) != i) continue;
    std::size_t slot = slot_of(entries[i].cell, table.size());
    while (table[slot] >= 0) slot = (slot + 1) & (table.size() - 1);
    table[slot] = static_cast<std::int32_t>(i);
  }
}

Scatterer SpeckleCells::scatterer(const Insonification& batch, const Insonified& first) const {
  const trace::Hit hit = batch.hits[first.ray];
  const auto bits = stream_.bits(first.cell);
  const Vec3 inside(0x1p-16 * (bits[2] & 0xffff), 0x1p-16 * (bits[2] >> 16), 0x1p-16 * (bits[3] & 0xffff));
  const Vec3 cell = (hit.position_enu_m * per_cell_ + kShift).array().floor();
  const Vec3 somewhere = cell_m_ * (cell + inside - kShift);
  const Vec3 normal = hit.normal_enu.cast<double>();
  const double straight_m = hit.range_m;
  const Vec3 launch = batch.pose.enu_from_head * batch.rays.direction_head[first.ray].cast<double>();

  Scatterer found;
  found.position_enu_m = somewhere - normal * normal.dot(somewhere - hit.position_enu_m);
  found.bend_enu = (launch - (hit.position_enu_m - batch.pose.position_enu_m) / straight_m).cast<float>();
  found.slowness_spm = hit.travel_time_s / hit.range_m;
  found.stretch = hit.path_length_m / hit.range_m;
  found.spreading = hit.tube_m2 / (hit.range_m * hit.range_m);
  found.scattered_upa2m2 = first.scattered_upa2m2;
  found.cross_section_m2 = first.cross_section_m2;
  found.response = gaussian(bits[0], bits[1]);
  found.contributor = first.contributor;
  return found;
}

void SpeckleCells::gather(Accumulator& sum, Scatterers& found) {
  auto& start = sum.start_;
  start.assign(1, 0);
  for (const Bucket& bucket : sum.buckets_) start.push_back(start.back() + bucket.entries.size());
  found.make_elements(start.back());
  tbb::parallel_for(std::size_t{0}, kBuckets, [&](std::size_t number) {
    const std::vector<Entry>& entries = sum.buckets_[number].entries;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const Entry& own = entries[i];
      const Entry& cell = entries[static_cast<std::size_t>(own.first)];  // of all of its contributors
      Scatterer one = own.scatterer;
      one.scattered_upa2m2 = cell.scatterer.scattered_upa2m2;
      one.cross_section_m2 = cell.scatterer.cross_section_m2;
      if (cell.next >= 0 && one.scattered_upa2m2 > 0.0F) one.share = own.own_upa2m2 / one.scattered_upa2m2;
      found.set(start[number] + i, one);
    }
  });
}

}  // namespace ensonify::echo

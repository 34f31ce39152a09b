#include "kernels/acoustics/echo/scatterer.h"

#include <tbb/blocked_range.h>
#include <tbb/task_arena.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "kernels/acoustics/trace/batch.h"

namespace ensonify::echo {
namespace {

using frames::Vec3;

constexpr std::size_t kRaysPerTask = 4096;
constexpr std::size_t kBuckets = 256;
constexpr std::uint64_t kNothing = ~std::uint64_t{0};  // no cell has this number: cells use 63 bits
constexpr int kBits = 21;
constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;
/// Blocks of 16 cells each way go to one bucket, so that the hits of a bucket stand together in memory.
constexpr std::uint64_t kBlock =
    ~(std::uint64_t{15} | (std::uint64_t{15} << kBits) | (std::uint64_t{15} << (2 * kBits)));

/// The top bits are well mixed.
std::uint64_t spread(std::uint64_t cell) { return cell * 0x9e3779b97f4a7c15ULL; }
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

Scatterers::Scatterers(double cell_m, const random::Stream& stream)
    : cell_m_(cell_m), per_cell_(1.0 / cell_m), stream_(stream) {
  if (!(cell_m > 0.0)) throw std::invalid_argument("the cells of scatterers must have a size above 0 m");
}

std::uint64_t Scatterers::cell_at(const Vec3& position_enu_m) const {
  const Vec3 cell = position_enu_m * per_cell_ + kShift;
  const auto index = [](double x) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x))) & kMask;
  };
  return index(cell.x()) | (index(cell.y()) << kBits) | (index(cell.z()) << (2 * kBits));
}

Scatterers::Insonified Scatterers::insonified_by(const Transmission& transmission, std::size_t ray) const {
  const trace::Hits& hits = transmission.hits;
  if (!hits.hit(ray)) return {kNothing, 0, 0, 0.0F, 0.0F, 0.0F, 0, -1};
  const float sigma_solid =
      transmission.backscatter[ray] * transmission.rays.solid_angle_sr[ray] / std::max(hits.sin_grazing[ray], 1e-3F);
  const float scattered_upa2m2 = transmission.source_upa2m2[ray] * sigma_solid;
  return {cell_at(hits.position_enu_m[ray]),
          static_cast<std::uint32_t>(ray),
          hits.contributor[ray],
          scattered_upa2m2,
          hits.tube_m2[ray] * sigma_solid,
          scattered_upa2m2,
          0,
          -1};
}

/// Brings the rays of each cell and contributor together at the front of `insonified`, in the order in which they are
/// first found; how many.
std::size_t Scatterers::merge(std::span<Insonified> insonified, std::span<std::int32_t> table) const {
  std::fill(table.begin(), table.end(), -1);
  const std::size_t last_slot = table.size() - 1;
  std::size_t entries = 0;
  for (const Insonified& one : insonified) {
    std::size_t slot = (spread(one.cell) >> 40) & last_slot;
    while (table[slot] >= 0 && insonified[static_cast<std::size_t>(table[slot])].cell != one.cell)
      slot = (slot + 1) & last_slot;
    const auto entry = static_cast<std::int32_t>(entries);
    if (table[slot] < 0) {
      table[slot] = entry;
      insonified[entries] = one;
      insonified[entries++].first = entry;
      continue;
    }
    Insonified& cell = insonified[static_cast<std::size_t>(table[slot])];
    cell.scattered_upa2m2 += one.scattered_upa2m2;
    cell.cross_section_m2 += one.cross_section_m2;
    Insonified* same = &cell;
    while (same->contributor != one.contributor && same->next >= 0)
      same = &insonified[static_cast<std::size_t>(same->next)];
    if (same->contributor == one.contributor) {
      same->own_upa2m2 += one.own_upa2m2;
    } else {
      same->next = entry;
      insonified[entries] = one;
      insonified[entries++].first = table[slot];
    }
  }
  return entries;
}

Scatterer Scatterers::scatterer(const Transmission& transmission, std::span<const Insonified> merged,
                                std::size_t entry) const {
  const Insonified& own = merged[entry];
  const Insonified& insonified = merged[static_cast<std::size_t>(own.first)];  // of all of its cell
  const trace::Hit hit = transmission.hits[insonified.ray];
  const auto bits = stream_.bits(insonified.cell);
  const Vec3 inside(0x1p-16 * (bits[2] & 0xffff), 0x1p-16 * (bits[2] >> 16), 0x1p-16 * (bits[3] & 0xffff));
  const Vec3 cell = (hit.position_enu_m * per_cell_ + kShift).array().floor();
  const Vec3 somewhere = cell_m_ * (cell + inside - kShift);
  const Vec3 normal = hit.normal_enu.cast<double>();
  const double straight_m = hit.range_m;
  const Vec3 launch = transmission.pose.enu_from_head * transmission.rays.direction_head[insonified.ray].cast<double>();

  Scatterer found;
  found.position_enu_m = somewhere - normal * normal.dot(somewhere - hit.position_enu_m);
  found.bend_enu = (launch - (hit.position_enu_m - transmission.pose.position_enu_m) / straight_m).cast<float>();
  found.slowness_spm = hit.travel_time_s / hit.range_m;
  found.stretch = hit.path_length_m / hit.range_m;
  found.spreading = hit.tube_m2 / (hit.range_m * hit.range_m);
  found.sin_grazing = hit.sin_grazing;
  found.scattered_upa2m2 = insonified.scattered_upa2m2;
  found.cross_section_m2 = insonified.cross_section_m2;
  found.response = gaussian(bits[0], bits[1]);
  if (insonified.next >= 0 && insonified.scattered_upa2m2 > 0.0F)
    found.share = own.own_upa2m2 / insonified.scattered_upa2m2;
  found.contributor = own.contributor;
  return found;
}

std::span<const Scatterer> Scatterers::find(const Transmission& transmission, Memory& memory) const {
  auto& insonified = memory.insonified;
  auto& by_cell = memory.by_cell;
  auto& merged_start = memory.merged_start;
  auto& tables = memory.tables;
  auto& found = memory.found;
  trace::make_elements(insonified, transmission.hits.size());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, insonified.size(), kRaysPerTask),
      [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) insonified[i] = insonified_by(transmission, i);
      },
      tbb::simple_partitioner());
  by_cell.sort(insonified, kBuckets, [](const Insonified& one) {
    return one.cell == kNothing ? kBuckets : static_cast<std::size_t>(spread(one.cell & kBlock) >> 56);
  });

  const std::size_t table_size = std::bit_ceil(2 * by_cell.largest() + 1);
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  if (tables.size() < threads) tables.resize(threads);
  for (auto& table : tables) {
    if (table.size() < table_size) table.resize(table_size);
  }
  merged_start.resize(kBuckets + 1);
  tbb::parallel_for(std::size_t{0}, kBuckets, [&](std::size_t bucket) {
    auto& table = tables[static_cast<std::size_t>(tbb::this_task_arena::current_thread_index())];
    merged_start[bucket + 1] = merge(by_cell.bucket(bucket), std::span(table).first(table_size));
  });
  merged_start[0] = 0;
  for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) merged_start[bucket + 1] += merged_start[bucket];
  trace::make_elements(found, merged_start.back());
  tbb::parallel_for(std::size_t{0}, kBuckets, [&](std::size_t bucket) {
    const auto merged = by_cell.bucket(bucket);
    for (std::size_t i = merged_start[bucket]; i < merged_start[bucket + 1]; ++i) {
      found[i] = scatterer(transmission, merged, i - merged_start[bucket]);
    }
  });
  return found;
}

}  // namespace ensonify::echo

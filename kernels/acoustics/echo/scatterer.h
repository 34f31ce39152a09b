#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/acoustics/trace/batch.h"
#include "kernels/acoustics/trace/ray.h"
#include "kernels/acoustics/trace/scene.h"
#include "kernels/base/frames/pose.h"
#include "kernels/base/random/stream.h"

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

/// One transmission and what its rays hit. Hits and spans have one entry per ray.
struct Transmission {
  frames::HeadPose pose;
  const trace::Rays& rays;
  const trace::Hits& hits;
  /// Mean-square pressure at 1 m in the ray's direction, uPa^2 m^2: source level with the transmit pattern.
  std::span<const float> source_upa2m2;
  /// Scattering cross section per unit area and solid angle at the hit, a ratio (seabed kernel).
  std::span<const float> backscatter;
};

/// A patch of seabed that answers as one point.
struct Scatterer {
  frames::Vec3 position_enu_m = frames::Vec3::Zero();
  Eigen::Vector3f bend_enu = Eigen::Vector3f::Zero();  // the ray's direction at the head, less the straight line's
  float slowness_spm = 0.0F;                           // travel time over straight distance
  float stretch = 1.0F;                                // path length over straight distance
  float spreading = 1.0F;                              // area of the ray tube over the square of the straight distance
  float sin_grazing = 0.0F;
  float scattered_upa2m2 = 0.0F;  // mean-square pressure at 1 m that the patch sends back, before absorption
  float cross_section_m2 = 0.0F;  // what it would scatter of a plane wave: sum of sigma dA
  std::complex<float> response;   // its random part: complex Gaussian, mean square 1
  float share = 1.0F;             // of the patch's pressure that is its contributor's, as its energy is shared
  std::uint32_t contributor = 0;  // by the direct path
};

/// From hits to scatterers.
///
/// The world is cut into cubic cells of `cell_m`. All rays that hit one cell add their energy to one scatterer. Its
/// place (in the cell, on the facet) and its response depend on (stream, cell) only. So a ping repeated from the same
/// pose with the same rays repeats bit by bit, and when the head moves, the same scatterers answer with other travel
/// times: the sum decorrelates by these, as a real seabed's does. That needs some four rays per cell; with fewer, the
/// scatterers that a ping finds change from ping to ping and it decorrelates sooner. Energy is right in any case.
///
/// Where one cell has several contributors each has a scatterer of its own. They share the cell's place, response and
/// pressure, so that their sum is what one scatterer of all the energy would send.
///
/// A cell's response is Gaussian, as that of a patch of many wavelengths: the sum of a few cells has the speckle of an
/// incoherent seabed. Choose cells of at most half the range resolution and a quarter of the footprint. The spacing of
/// cells is exact to 2^20 cells from the world's origin; beyond they repeat.
class Scatterers {
  struct Insonified {  // by one ray, then by all rays of a cell
    std::uint64_t cell;
    std::uint32_t ray, contributor;
    float scattered_upa2m2, cross_section_m2;
    // Once rays are merged: the cell's entries, one for each contributor.
    float own_upa2m2;          // of this contributor
    std::int32_t first, next;  // entries of the cell; the first has the sums of all; -1: there is no other
  };

 public:
  /// Memory of a search: its contents do not matter.
  class Memory {
    friend Scatterers;
    std::vector<Insonified> insonified;
    Partition<Insonified> by_cell;
    std::vector<std::size_t> merged_start;
    std::vector<std::vector<std::int32_t>> tables;  // one per thread
    std::vector<Scatterer> found;
  };

  /// Throws std::invalid_argument unless cell_m > 0.
  Scatterers(double cell_m, const random::Stream& stream);

  /// The scatterers of a transmission in a fixed order; they lie in the memory given.
  ///
  /// A ray of solid angle dOmega that hits the seabed at grazing angle theta insonifies dA = tube dOmega / sin(theta)
  /// with source / tube, so it sends back source sigma dOmega / sin(theta), whatever the path: spreading out is counted
  /// by the rays themselves. sin(theta) below 0.001 counts as that.
  std::span<const Scatterer> find(const Transmission& transmission, Memory& memory) const;

 private:
  std::uint64_t cell_at(const frames::Vec3& position_enu_m) const;
  Insonified insonified_by(const Transmission& transmission, std::size_t ray) const;
  std::size_t merge(std::span<Insonified> insonified, std::span<std::int32_t> table) const;
  Scatterer scatterer(const Transmission& transmission, std::span<const Insonified> merged, std::size_t entry) const;

  double cell_m_, per_cell_;
  random::Stream stream_;
};

}  // namespace ensonify::echo

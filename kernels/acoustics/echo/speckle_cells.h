#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/acoustics/echo/partition.h"
#include "kernels/acoustics/echo/scatterer.h"
#include "kernels/acoustics/trace/ray.h"
#include "kernels/acoustics/trace/scene.h"
#include "kernels/base/frames/pose.h"
#include "kernels/base/random/stream.h"

namespace ensonify::echo {

/// Rays of a transmission, all or a batch of them, and what they hit. Hits and spans have one entry per ray.
struct Insonification {
  const frames::HeadPose& pose;  // of the head
  const trace::Rays& rays;
  const trace::Hits& hits;
  /// Mean-square pressure at 1 m in the ray's direction, uPa^2 m^2: source level with the transmit pattern.
  std::span<const float> source_upa2m2;
  /// Scattering cross section per unit area and solid angle at the hit, a ratio (seabed kernel).
  std::span<const float> backscatter;
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
class SpeckleCells {
  static constexpr std::size_t kBuckets = 256;

  struct Insonified {  // by one ray
    std::uint64_t cell;
    std::uint32_t ray, contributor;
    float scattered_upa2m2, cross_section_m2;
  };
  /// Of a cell, one for each contributor.
  struct Entry {
    std::uint64_t cell;
    float own_upa2m2;          // of this contributor
    std::int32_t first, next;  // entries of the cell; the first has the sums of all; -1: there is no other
    Scatterer scatterer;       // with the geometry of the cell's first ray
  };
  /// Cells that are near each other, in the order in which they are first found.
  struct Bucket {
    std::vector<Entry> entries;
    std::vector<std::int32_t> table;  // of cells' first entries, by hash
  };

 public:
  /// What the batches of a transmission have insonified so far. Memory of the caller's: as long as there are
  /// scatterers, and as the longest batch.
  class Accumulator {
   public:
    Accumulator() : buckets_(kBuckets) {}
    void clear();

   private:
    friend SpeckleCells;
    std::vector<Insonified> insonified_;
    Partition<Insonified> by_bucket_;
    std::vector<Bucket> buckets_;
    std::vector<std::size_t> start_;
  };

  /// Throws std::invalid_argument unless cell_m > 0.
  SpeckleCells(double cell_m, const random::Stream& stream);

  /// Adds what rays insonify. Sums are in the order of rays, whatever the batches: the same bits.
  ///
  /// A ray of solid angle dOmega that hits the seabed at grazing angle theta insonifies dA = tube dOmega / sin(theta)
  /// with source / tube, so it sends back source sigma dOmega / sin(theta), whatever the path: spreading out is counted
  /// by the rays themselves. sin(theta) below 0.001 counts as that.
  void add(const Insonification& batch, Accumulator& sum) const;

  /// The scatterers of all batches since the accumulator was cleared, in a fixed order. `found` is overwritten.
  static void gather(Accumulator& sum, Scatterers& found);

 private:
  std::uint64_t cell_at(const frames::Vec3& position_enu_m) const;
  Insonified insonified_by(const Insonification& batch, std::size_t ray) const;
  void merge(const Insonification& batch, std::span<const Insonified> insonified, Bucket& bucket) const;
  Scatterer scatterer(const Insonification& batch, const Insonified& first) const;
  static void grow(Bucket& bucket);

  double cell_m_, per_cell_;
  random::Stream stream_;
};

}  // namespace ensonify::echo

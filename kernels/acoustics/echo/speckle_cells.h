#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/acoustics/echo/cell_columns.h"
#include "kernels/acoustics/echo/partition.h"
#include "kernels/acoustics/echo/scatterer.h"
#include "kernels/base/random/stream.h"

namespace ensonify::echo {

/// From hits to scatterers.
///
/// The world is cut into cubic cells of `cell_m`. All rays that hit one cell add their energy to one scatterer. Its
/// place (in the cell, on the facet) and its response depend on (a stream, cell) only. So a ping repeated from the same
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

  /// Of a cell, one for each contributor: sums of its rays.
  struct Entry {
    std::uint64_t cell;
    float scattered_upa2m2, cross_section_m2;
    std::uint32_t contributor;
    std::uint32_t scatterer;   // while a batch is merged, of a new entry: the first ray
    std::int32_t first, next;  // entries of the cell; -1: there is no other
  };
  /// Cells that are near each other, in the order in which they are first found.
  struct Bucket {
    std::vector<Entry> entries;
    std::vector<std::int32_t> table;  // of cells' first entries, by hash; of an earlier ping while there are no entries
    std::size_t numbered = 0;         // entries that have their scatterer
  };

 public:
  /// What the batches of a transmission have insonified so far. Memory of the caller's: as long as there are
  /// scatterers, and as the longest batch. Scatterers are in the order of the rays that first find them, so the rows of
  /// hits that make some are read, and those of scatterers written, one after the other and once.
  class Accumulator {
   public:
    Accumulator() : buckets_(kBuckets) {}
    void clear();

   private:
    friend SpeckleCells;
    Partition<CellHit> by_bucket_;
    std::vector<Bucket> buckets_;
    std::vector<std::uint32_t> number_;  // by ray of a batch: 1 if it makes a scatterer; then that one's number
    std::vector<std::uint32_t> makers_;  // rays of a batch that make one
    Scatterers found_;                   // yet without energies
  };

  /// Throws std::invalid_argument unless cell_m > 0.
  SpeckleCells(double cell_m, const CellStreams& streams);

  /// Adds what rays insonify. Sums are in the order of rays, whatever the batches: the same bits.
  ///
  /// A ray of solid angle dOmega that hits the seabed at grazing angle theta insonifies dA = tube dOmega / sin(theta)
  /// with source / tube, so it sends back source sigma dOmega / sin(theta), whatever the path: spreading out is counted
  /// by the rays themselves. sin(theta) below 0.001 counts as that.
  void add(const Insonification& batch, Accumulator& sum) const;

  /// The scatterers of all batches since the accumulator was cleared, in the order in which rays find them, whatever
  /// the batches. They lie in the accumulator until it is cleared.
  /// After them come `more`, which other stages have found.
  static const Scatterers& gather(Accumulator& sum, const Scatterers& more = {});

  double cell_m() const { return cell_m_; }
  const random::Stream& responses() const { return streams_.responses(); }

 private:
  static void merge(std::span<const CellHit> hits, Bucket& bucket, std::span<std::uint32_t> makes);
  void find_new(const Insonification& batch, Accumulator& sum) const;
  static void number_new(std::span<const std::uint32_t> number, Bucket& bucket, Scatterers& found);
  static void grow(Bucket& bucket);
  static void take_energies(const Bucket& bucket, Scatterers& found);

  double cell_m_;
  CellStreams streams_;
};

}  // namespace ensonify::echo

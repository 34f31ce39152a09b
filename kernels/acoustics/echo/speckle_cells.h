#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/acoustics/echo/cell_columns.h"
#include "kernels/acoustics/echo/cell_table.h"
#include "kernels/acoustics/echo/scatterer.h"
#include "kernels/base/random/stream.h"

namespace ensonify::echo {

/// From hits to scatterers.
///
/// The world is cut into cells (cell_lattice.h). All rays that hit one cell add their energy to one scatterer. Its
/// place (in the cell, on the facet) and its response depend on (a stream, cell) only. So a ping repeated from the same
/// pose with the same rays repeats bit by bit, and when the head moves, the same scatterers answer with other travel
/// times: the sum decorrelates by these, as a real seabed's does. That needs some four rays per cell; with fewer, the
/// scatterers that a ping finds change from ping to ping and it decorrelates sooner. Energy is right in any case.
/// Long cells are those of a course: on another one, 9 degrees away, others answer from the same ground.
///
/// Where one cell has several contributors each has a scatterer of its own. They share the cell's place, response and
/// pressure, so that their sum is what one scatterer of all the energy would send.
///
/// A cell's response is Gaussian, as that of a patch of many wavelengths: the sum of a few cells has the speckle of an
/// incoherent seabed. Choose cells of at most half the range resolution and a quarter of the footprint. The spacing of
/// cells is exact to 2^20 cells from the world's origin; beyond they repeat.
class SpeckleCells {
 public:
  /// What the batches of a transmission have insonified so far. Memory of the caller's: as long as there are
  /// scatterers, and as the longest batch. Scatterers are in the order of the rays that first find them, so the rows of
  /// hits that make some are read, and those of scatterers written, one after the other and once.
  class Accumulator {
   public:
    void clear();

   private:
    friend SpeckleCells;
    void make_rows(std::size_t count);

    CellTable first_of_;                  // the first scatterer of each cell
    std::uint32_t size_ = 0;              // scatterers so far; rows behind them are of the last ping
    Scatterers found_;                    // with the sums of their rays, not yet shared
    std::vector<std::uint32_t> another_;  // by scatterer: the next one of its cell, by another contributor, or kNone
    std::vector<std::uint32_t> shared_;   // first scatterers of cells that have several
    std::vector<std::uint32_t> makers_;   // rays of a batch that make one
    struct Other {
      std::uint32_t scatterer, first;
    };
    std::vector<Other> others_;  // that a batch finds in cells which have one
    CellParts parts_;            // where the caller has none
  };

  /// Throws std::invalid_argument unless the cells' edges are above 0 m.
  SpeckleCells(const CellSize& size, const CellStreams& streams);

  /// Adds what rays insonify. Sums are in the order of rays, whatever the batches: the same bits.
  ///
  /// A ray of solid angle dOmega that hits the seabed at grazing angle theta insonifies dA = tube dOmega / sin(theta)
  /// with source / tube, so it sends back source sigma dOmega / sin(theta), whatever the path: spreading out is counted
  /// by the rays themselves. sin(theta) below 0.001 counts as that.
  void add(const Insonification& batch, Accumulator& sum) const;

  /// The same in two steps, of which the first may be taken for several batches at once: what the first `rays` of a
  /// batch bring to their cells, and adding that.
  void find_parts(const Insonification& batch, std::size_t rays, CellParts& parts) const;
  void add(const Insonification& batch, const CellParts& parts, Accumulator& sum) const;

  /// The scatterers of all batches since the accumulator was cleared, in the order in which rays find them, whatever
  /// the batches. They lie in the accumulator until it is cleared; no batch is added before that.
  /// After them come `more`, which other stages have found.
  static const Scatterers& gather(Accumulator& sum, const Scatterers& more = {});

  double cell_m() const { return size_.cube_m; }
  const random::Stream& responses() const { return streams_.responses(); }

 private:
  static constexpr std::uint32_t kNone = CellTable::kNone;
  static void merge(const CellParts& parts, std::span<const std::uint32_t> contributors, Accumulator& sum);
  void place_new(const Insonification& batch, std::size_t before, Accumulator& sum) const;
  static void share(Accumulator& sum);

  CellSize size_;
  CellStreams streams_;
};

}  // namespace ensonify::echo

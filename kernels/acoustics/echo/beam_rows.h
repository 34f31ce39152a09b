#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

#include "kernels/acoustics/echo/spreading.h"

namespace ensonify::echo {

/// A block of samples of a sine grid, as beams read it: the samples of a cell side by side, so that one step of a
/// beam's sum is of many samples.
class BeamRows {
 public:
  static constexpr std::size_t kSamples = 32;  // in a block

  /// Of grid[sample * stride + cell], cells 0..stride - 1.
  void set(const std::complex<float>* grid, std::size_t stride);

  /// Numbers of a beam, sample by sample: re, im.
  using Row = std::array<float, 2 * kSamples>;
  /// Of the beam whose six points begin at a cell.
  void read(std::size_t first, const Spreading::Taps& taps, Row& row) const;

 private:
  std::vector<float> cells_;  // cell by sample: re, im
};

/// Adds rows: of a line's halves those of the whole.
void add(const BeamRows::Row& one, const BeamRows::Row& other, BeamRows::Row& sum);
/// Magnitudes, one for each sample.
void magnitudes(const BeamRows::Row& row, std::array<float, BeamRows::kSamples>& amplitude);

}  // namespace ensonify::echo

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/acoustics/echo/arrival.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/acoustics/echo/spreading.h"
#include "kernels/acoustics/echo/time_index.h"

namespace ensonify::echo {

/// An arrival on a grid of sample by sine: all that spreading needs, together in memory.
struct GridPoint {
  std::int32_t first, phase;  // of its envelope (SampledPulse::Place)
  std::int32_t cell;          // along sine, 0..cells - 1
  float offset;               // beyond it, in cells, 0..1
  float re_upa, im_upa;       // pressure with the element's gain
};

/// Sines on a periodic grid.
struct SineGrid {
  Eigen::Vector3f axis_head;
  double spacing_in_waves;
  int cells;

  struct At {
    std::int32_t cell;
    float offset;
  };
  At at(float sine) const {
    const double turns = spacing_in_waves * static_cast<double>(sine);
    const auto position = static_cast<float>((turns - std::floor(turns)) * cells);
    const auto cell = std::min(static_cast<std::int32_t>(position), cells - 1);
    return {cell, position - static_cast<float>(cell)};
  }
};

/// From arrivals of a ping to points. Those of contributors that are not wanted come after all samples.
struct GridPoints {
  std::span<const EchoSet> echoes;
  const ContributorSet& whose;
  const SampledPulse& pulse;
  Sampling sampling;
  SineGrid grid;

  /// All of them, in order of sets and within each of arrivals.
  void sort(ByTime<GridPoint>& points) const;
};

/// Adds what is received in a block to rows of a grid, one for each sample, so many complex numbers apart. A number is
/// spread over as many points as Spreading says, from its cell on.
void spread(const ByTime<GridPoint>& points, int block, const SampledPulse& pulse, const Spreading& spreading,
            std::complex<float>* rows, std::ptrdiff_t stride);

}  // namespace ensonify::echo

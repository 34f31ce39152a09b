#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "kernels/acoustics/echo/arrival.h"
#include "kernels/acoustics/echo/pulse.h"

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

/// Points of arrivals first..last - 1 of a set. Those of contributors that are not wanted come after all samples.
void make_points(const EchoSet& set, std::size_t first, std::size_t last, const SineGrid& grid,
                 const SampledPulse& pulse, const Sampling& sampling, const ContributorSet& whose, GridPoint* points);

}  // namespace ensonify::echo

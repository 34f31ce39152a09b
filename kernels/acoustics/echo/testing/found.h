#pragma once

#include "kernels/acoustics/echo/speckle_cells.h"

/// Test support: scatterers of rays in one batch.
namespace ensonify::echo {

inline Scatterers scatterers_of(const SpeckleCells& cells, const Insonification& all) {
  SpeckleCells::Accumulator sum;
  cells.add(all, sum);
  return SpeckleCells::gather(sum);
}

}  // namespace ensonify::echo

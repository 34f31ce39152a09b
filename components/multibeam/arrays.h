#pragma once

#include "components/multibeam/config.h"
#include "kernels/array/line_array.h"

namespace ensonify {

/// The receive line of a head, as it is and as its processing knows it.
struct ReceiveLine {
  double wavelength_m = 0.005;  // that it was designed for
  array::LineArray whole;
  array::SplitAperture halves;  // positive: starboard
};

ReceiveLine receive_line(const MultibeamConfig& config);

}  // namespace ensonify

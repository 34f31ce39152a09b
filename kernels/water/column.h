#pragma once

#include <vector>

#include "kernels/water/absorption.h"

namespace ensonify::water {

/// The water from surface to bottom, as a cast gives it: linear between samples, constant above the first and below the
/// last.
class Column {
 public:
  /// One sample at each depth, depths rising; std::invalid_argument says which does not, and that one is needed.
  explicit Column(std::vector<SeaWater> samples);

  SeaWater at(double depth_m) const;

  /// Absorption averaged over depth, in dB/m: what a straight path between the two depths has, whatever its slope. At
  /// one depth, the absorption there. The order of the depths does not matter.
  double mean_absorption_dbpm(AbsorptionLaw law, double frequency_hz, double from_depth_m, double to_depth_m) const;

 private:
  std::vector<SeaWater> samples_;
};

}  // namespace ensonify::water

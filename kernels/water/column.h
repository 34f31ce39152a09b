#pragma once

#include <span>
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

/// A layer of scatterers: plankton, fish, suspended sediment, bubbles.
///
/// Volume scattering strength sv_db is 10 log10 of the scattered over incident intensity per unit volume and solid
/// angle, dB re 1/m, averaged over what drifts by. At 100..400 kHz about -85 in clear water, -70 on a typical coast,
/// -55 in a dense layer; rough figures, so measure or choose.
struct ScatteringLayer {
  double top_depth_m;     // positive down; the layer holds top <= depth < bottom
  double bottom_depth_m;  // below top
  double sv_db;
};

/// Volume scattering strength at a depth, dB re 1/m: the powers of all layers that hold it; -inf between layers.
double volume_scattering_db(std::span<const ScatteringLayer> layers, double depth_m);

}  // namespace ensonify::water

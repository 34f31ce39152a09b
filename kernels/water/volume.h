#pragma once

#include <span>

namespace ensonify::water {

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

#include "kernels/water/volume.h"

#include <cmath>

namespace ensonify::water {

double volume_scattering_db(std::span<const ScatteringLayer> layers, double depth_m) {
  double sv = 0.0;
  for (const ScatteringLayer& layer : layers) {
    if (depth_m >= layer.top_depth_m && depth_m < layer.bottom_depth_m) sv += std::pow(10.0, layer.sv_db / 10.0);
  }
  return 10.0 * std::log10(sv);
}

}  // namespace ensonify::water

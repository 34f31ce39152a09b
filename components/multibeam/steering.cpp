#include "components/multibeam/steering.h"

#include <cmath>

#include "kernels/array/beam_layout.h"

namespace ensonify {

Steering steer(const MultibeamConfig& config, double sound_speed_mps) {
  Steering steering;
  steering.sound_speed_mps = sound_speed_mps;
  const double half = 0.5 * config.swath_rad;
  steering.beam_angle_rad = config.spacing == MultibeamConfig::Spacing::kEquiangle
                                ? array::equiangular_beams_rad(half, config.beams)
                                : array::equidistant_beams_rad(half, config.beams);
  for (const float angle : steering.beam_angle_rad) steering.sin_beams.push_back(std::sin(angle));
  return steering;
}

}  // namespace ensonify

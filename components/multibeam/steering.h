#pragma once

#include <vector>

#include "components/multibeam/config.h"

namespace ensonify {

/// What the head tells its arrays in one ping, by what it believes.
struct Steering {
  double sound_speed_mps = 1500.0;    // at the face: delays are made for it
  std::vector<float> sin_beams;       // of the receive beams, from the plane across the head's y axis
  std::vector<float> beam_angle_rad;  // their angles from its z axis, positive to starboard
};

/// The beams of a head that believes in this sound speed at its face.
Steering steer(const MultibeamConfig& config, double sound_speed_mps);

}  // namespace ensonify

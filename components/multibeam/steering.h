#pragma once

#include <optional>
#include <vector>

#include "components/multibeam/config.h"
#include "kernels/frames/attitude.h"

namespace ensonify {

/// What the head believes when it transmits: what its sensors have told by then, errors and latency included.
struct Belief {
  double sound_speed_mps = 1500.0;          // at the face
  std::optional<frames::Attitude> vehicle;  // by the motion sensor; nothing: nothing can be stabilised
};

/// What the head tells its arrays in one ping. Sines are from the planes across its x axis (transmit) and its y axis
/// (receive).
struct Steering {
  double sound_speed_mps = 1500.0;  // delays are made for it
  double sin_transmit = 0.0;        // of the fan
  double middle_rad = 0.0;          // of the fan, about the head's x axis from its z axis, positive to starboard
  std::vector<float> sin_beams;
  std::vector<float> beam_angle_rad;  // their arcsines
  std::vector<float> across_rad;      // angles that the beams are to have: from the vertical when roll is stabilised
  bool roll_stabilised = false;
  bool pitch_stabilised = false;
};

/// The fan goes through the vertical below the head, and the beams cut it at their angles from there, as far as roll
/// and pitch are stabilised; else from the head's z axis. Both stay as they are for the whole ping. A beam that would
/// have to look behind the face lies along it.
Steering steer(const MultibeamConfig& config, const Belief& belief);

}  // namespace ensonify

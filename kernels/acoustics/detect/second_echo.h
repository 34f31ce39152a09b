#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernels/acoustics/detect/bottom.h"

/// Internal to this folder: which beams took the echo by way of the surface for the bottom (bottom.h, SecondEcho).
namespace ensonify::detect {

/// A beam that received the second echo, and the slant range short of which it is to seek the bottom.
struct DetectedSecondEcho {
  std::size_t beam = 0;
  double farthest_m = 0.0;
};

/// In order of beams. detections: max_detections of each beam, as detect_bottom leaves them. Allocates for what it
/// finds only.
std::vector<DetectedSecondEcho> second_echoes(const Settings& settings, std::span<const float> sin_beams,
                                              std::span<const Detection> detections);

}  // namespace ensonify::detect

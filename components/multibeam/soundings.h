#pragma once

#include <vector>

#include "components/multibeam/config.h"
#include "components/runtime/head/auto_range.h"
#include "components/runtime/head/shot.h"
#include "kernels/detect/bottom.h"
#include "kernels/frames/pose.h"
#include "messages/soundings.h"

namespace ensonify {

/// What the instrument makes of a ping: bottom detections and where they are, by what it knows: its settings, the
/// navigation estimate, the measured mounting and its sound-speed probe. Never the truth.
class SoundingMaker {
 public:
  SoundingMaker(const MultibeamConfig& config, std::vector<float> beam_angle_rad);

  /// Soundings of a ping. Without an estimate none is valid.
  msg::Soundings make(const Shot& shot, const detect::Amplitudes& image, const frames::PoseHistory& estimate);

  /// What the valid soundings of the last ping heard.
  const std::vector<HeardBottom>& heard() const { return heard_; }

 private:
  void drop_beyond_range();
  void place(const Shot& shot, const frames::PoseHistory& estimate, std::size_t beam, msg::Soundings& soundings);

  MultibeamConfig config_;
  std::vector<float> beam_angle_rad_;
  std::vector<float> sin_beams_;
  detect::Settings settings_;
  std::vector<detect::Detection> detections_;
  std::vector<HeardBottom> heard_;
};

}  // namespace ensonify

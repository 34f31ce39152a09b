#pragma once

#include <vector>

#include "components/multibeam/config.h"
#include "components/multibeam/steering.h"
#include "components/runtime/head/auto_range.h"
#include "components/runtime/head/shot.h"
#include "kernels/detect/bottom.h"
#include "kernels/frames/pose.h"
#include "kernels/refraction/profile.h"
#include "messages/soundings.h"

namespace ensonify {

/// What the instrument makes of a ping: bottom detections and where they are, by what it knows: its settings, the
/// navigation estimate, the measured mounting, the applied sound speed profile. Never the truth.
class SoundingMaker {
 public:
  explicit SoundingMaker(const MultibeamConfig& config);

  /// Soundings of a ping. Without an estimate none is valid.
  msg::Soundings make(const Shot& shot, const Steering& steering, const detect::Amplitudes& image,
                      const frames::PoseHistory& estimate);

  /// What the valid soundings of the last ping heard.
  const std::vector<HeardBottom>& heard() const { return heard_; }

 private:
  void drop_beyond_range(const Steering& steering);
  void place(const Shot& shot, const Steering& steering, const frames::PoseHistory& estimate, std::size_t beam,
             msg::Soundings& soundings);

  MultibeamConfig config_;
  refraction::SoundSpeedProfile applied_;
  detect::Settings settings_;
  std::vector<detect::Detection> detections_;
  std::vector<HeardBottom> heard_;
};

}  // namespace ensonify

#pragma once

#include <vector>

#include "components/multibeam/config.h"
#include "components/multibeam/head.h"
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

  /// Soundings of a ping, without settings and track. Without an estimate none is valid.
  msg::Soundings make(const Shot& shot, const Steering& steering, const MultibeamHead::Heard& heard,
                      const frames::PoseHistory& estimate);

  /// What the valid soundings of the last ping heard.
  const std::vector<HeardBottom>& heard() const { return heard_; }

 private:
  frames::HeadPose believed_pose(const frames::PoseHistory& estimate, SimTime t) const;
  void flag(const Steering& steering, msg::Soundings& soundings) const;
  void measure(double sound_speed_mps, std::size_t beam, double sample_period_s, msg::Soundings& soundings) const;
  void place(const Shot& shot, const Steering& steering, const frames::PoseHistory& estimate, std::size_t beam,
             msg::Soundings& soundings);

  MultibeamConfig config_;
  refraction::SoundSpeedProfile applied_;
  double transmit_length_in_waves_;
  detect::Settings settings_;
  std::vector<detect::Detection> detections_;
  std::vector<HeardBottom> heard_;
};

}  // namespace ensonify

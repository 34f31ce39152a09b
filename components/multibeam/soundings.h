#pragma once

#include <vector>

#include "components/multibeam/arrays.h"
#include "components/multibeam/config.h"
#include "components/multibeam/head.h"
#include "components/multibeam/relief_estimator.h"
#include "components/multibeam/steering.h"
#include "components/sonar/auto_range.h"
#include "components/sonar/ping_event.h"
#include "kernels/acoustics/detect/bottom.h"
#include "kernels/base/frames/pose.h"
#include "kernels/water/refraction/profile.h"
#include "messages/soundings.h"

namespace ensonify {

/// One detection of a ping: an entry of soundings/1.
struct Echo {
  int beam = 0;
  int detection = 0;  // of its beam, or of its place in the swath with high density
  int sector = 0;
  int place = 0;  // in Steering::sin_soundings
  detect::Detection measured;
};

/// Product of the instrument from a ping: bottom detections and where they are, by what it knows: its settings (with
/// the operator's absorption), the navigation estimate, the measured mounting, the applied sound speed profile. Never
/// the truth.
class SoundingMaker {
 public:
  /// The design must outlive it.
  SoundingMaker(const MultibeamConfig& config, const ArrayDesign& design);

  struct Made {
    std::vector<Echo> echoes;              // the detections behind the entries of the soundings
    msg::Soundings soundings;              // without settings and track
    std::vector<BottomDetection> bottoms;  // returns of the valid ones
  };
  /// Soundings of a ping. Without an estimate none is valid. `navigation`: what the estimate says of its own errors.
  Made make(const PingEvent& event, const HeadSettings& settings, const Steering& steering,
            std::span<const MultibeamHead::Received> received, const frames::PoseHistory& estimate,
            const uncertainty::Navigation& navigation);

 private:
  /// Half-power widths on a level seabed.
  struct Footprint {
    double across_m, along_m;
  };
  struct Ping {
    const PingEvent& event;
    const HeadSettings& settings;
    const Steering& steering;
    const frames::PoseHistory& estimate;
    const uncertainty::Navigation& navigation;
  };

  frames::HeadPose estimated_pose(const frames::PoseHistory& estimate, SimTime t) const;
  std::vector<Echo> detect(const Ping& ping, std::span<const MultibeamHead::Received> received);
  MultibeamHead::Received at_places(const Steering& steering, std::size_t sector, const MultibeamHead::Received& beams,
                                    std::span<const int> beam_of_place, std::span<const float> sin_places);
  static void flag(const Steering& steering, Made& made);
  void measure(const Ping& ping, std::size_t entry, double pulse_length_s, Made& made) const;
  void place(const Ping& ping, std::size_t entry, Made& made) const;
  uncertainty::Geometry motion(const Ping& ping) const;
  Footprint footprint(std::size_t entry, const frames::Vec3& away_enu_m, const Made& made) const;
  void update_relief(const uncertainty::Geometry& motion, const frames::Vec3& head_enu_m, const Made& made);
  void state_uncertainty(const Ping& ping, const uncertainty::Geometry& motion, Made& made);

  MultibeamConfig config_;
  refraction::SoundSpeedProfile applied_;
  const std::vector<SectorDesign>& sectors_;
  ReliefEstimator relief_;
  // Memory of the ping path.
  std::vector<detect::Detection> detections_;  // of one sector
  std::vector<ReliefEstimator::Sounding> profile_;
  // Beams turned to the places where soundings are sought, of high density.
  std::vector<float> amplitude_upa_;
  std::vector<std::complex<float>> positive_upa_, negative_upa_;
};

}  // namespace ensonify

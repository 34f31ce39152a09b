#pragma once

#include <vector>

#include "components/echosounder/config.h"
#include "components/sonar/aperture_echoes.h"
#include "components/sonar/bottom_finder.h"
#include "components/sonar/sea_acoustics.h"
#include "messages/sonar.h"

namespace ensonify {

/// Echoes of a ping at the piston, and the bottom that the instrument finds in them. The acoustics use the true motion,
/// mounting and water; the bottom only what was received.
class EchosounderHead {
 public:
  explicit EchosounderHead(const EchosounderConfig& config);

  struct Received {
    msg::Ping ping;  // without a track
    msg::BottomTrack bottom;
    TraceSummary trace;
  };
  /// A function of shot, settings, poses and tiles, and for the bottom of the pings before. `vehicle` has a pose.
  Received receive_echoes(const PingEvent& event, const HeadSettings& settings, const frames::PoseHistory& vehicle,
                          const trace::Scene& seabed);

 private:
  EchosounderConfig config_;
  ApertureEchoes echoes_;
  BottomFinder bottom_;
  ApertureEchoes::Memory memory_;
  std::vector<frames::HeadPose> poses_;
};

}  // namespace ensonify

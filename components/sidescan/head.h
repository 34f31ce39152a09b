#pragma once

#include <vector>

#include "components/sidescan/config.h"
#include "components/sonar/aperture_echoes.h"
#include "components/sonar/bottom_finder.h"
#include "components/sonar/line_design.h"
#include "components/sonar/sea_acoustics.h"
#include "messages/sonar.h"

namespace ensonify {

/// The patterns of a channel, port then starboard: a uniform line along x, another across the face, the face's back.
AperturePatterns side_patterns(const SidescanConfig& config, const SidescanChannel& channel);

/// One channel of a sidescan: what both sides receive of a ping, and where the instrument finds the bottom in it. The
/// acoustics use the true motion, mounting and water; the track of the bottom only what was received.
class SidescanHead {
 public:
  SidescanHead(const SidescanConfig& config, const SidescanChannel& channel);

  struct Received {
    msg::Ping ping;  // without a track
    msg::BottomTrack bottom;
    TraceSummary trace;
  };
  /// A function of shot, settings, poses and tiles, and for the bottom of the pings before. `vehicle` has a pose.
  Received receive_echoes(const PingEvent& event, const HeadSettings& settings, const frames::PoseHistory& vehicle,
                          const trace::Scene& seabed);

  std::size_t max_ping_bytes() const;

 private:
  SidescanHead(const SidescanConfig& config, const SidescanChannel& channel, const LineDesign& line);
  msg::Ping ping_message(const PingEvent& event, const HeadSettings& settings) const;

  SidescanConfig config_;
  SidescanChannel channel_;
  ApertureEchoes echoes_;
  BottomFinder bottom_;
  double pulse_length_s_;
  echo::Pulse pulse_;

  // Memory of the ping path.
  ApertureEchoes::Memory memory_;
  std::vector<frames::HeadPose> poses_;
};

}  // namespace ensonify

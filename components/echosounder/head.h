#pragma once

#include <vector>

#include "components/echosounder/config.h"
#include "components/sonar/aperture_echoes.h"
#include "components/sonar/bottom_finder.h"
#include "messages/sonar.h"

namespace ensonify {

/// What the piston hears of a ping, and where the instrument finds the bottom in it. The acoustics use the true motion,
/// mounting and water; the bottom only what was heard.
class EchosounderHead {
 public:
  explicit EchosounderHead(const EchosounderConfig& config);

  struct Heard {
    msg::Ping ping;  // without a track
    msg::BottomTrack bottom;
  };
  /// A function of shot, settings, poses and tiles, and for the bottom of the pings before. `vehicle` has a pose.
  Heard listen(const Shot& shot, const HeadSettings& settings, const frames::PoseHistory& vehicle,
               trace::Scene& seabed);

  /// How many rays of the last ping met the seabed within its range.
  int rays_that_hit() const { return echoes_.arrivals().rays_that_hit(); }

 private:
  EchosounderConfig config_;
  ApertureEchoes echoes_;
  BottomFinder bottom_;
  std::vector<frames::HeadPose> poses_;
};

}  // namespace ensonify

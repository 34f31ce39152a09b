#pragma once

#include <vector>

#include "components/scanning/config.h"
#include "components/sonar/aperture_echoes.h"
#include "components/sonar/line_design.h"
#include "components/sonar/sea_acoustics.h"

namespace ensonify {

/// The pattern of the transducer, in its own frame: x along its axis's projection onto the plane that it turns in.
array::Pattern scanning_pattern(const ScanningConfig& config);

/// The acoustics of a mechanically scanned head: what its one transducer receives where it points. It stands still
/// while it receives. Uses the true motion, the actual mounting and the true water.
class ScanningHead {
 public:
  explicit ScanningHead(const ScanningConfig& config);

  struct Received {
    msg::Ping ping;  // without a track
    TraceSummary trace;
  };
  /// The row of a ping: a function of the shot, the settings, the sound speed that the head knows, the poses while it
  /// receives, and the tiles.
  Received receive_echoes(const PingEvent& event, const HeadSettings& settings, double known_sound_speed_mps,
                          const frames::PoseHistory& truth, const trace::Scene& seabed);

  RangedPulse pulse_for(const HeadSettings& settings) const {
    return pulse_at(config_.pulse, settings.range_m, config_.sound_speed_mps, settings.pulse_length_s);
  }
  std::size_t max_ping_bytes() const;

 private:
  ScanningHead(const ScanningConfig& config, const LineDesign& line);

  ScanningConfig config_;
  ApertureEchoes echoes_;
  ApertureEchoes::Memory memory_;
  std::vector<frames::HeadPose> poses_;
};

}  // namespace ensonify

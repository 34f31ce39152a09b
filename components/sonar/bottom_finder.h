#pragma once

#include <vector>

#include "kernels/acoustics/detect/bottom_track.h"
#include "kernels/acoustics/echo/image.h"
#include "kernels/acoustics/echo/pulse.h"
#include "messages/sonar.h"

namespace ensonify {

/// Finder of the first bottom return, from ping to ping, by the instrument's own echoes and its own sound speed.
class BottomFinder {
 public:
  /// The length of a single echo is each ping's own, not that of these settings.
  explicit BottomFinder(const detect::FirstBottomSettings& settings) : settings_(settings) {}

  /// The track after one more ping. Each beam is judged alone; the track is that of all beams' mean power. The envelope
  /// is that before any gain, `pulse` what the filter makes of the echo of a point. Stamp and ping number are left to
  /// the caller.
  msg::BottomTrack find(const echo::Image& envelope, const echo::Sampling& sampling, const echo::Pulse& pulse,
                        double sound_speed_mps);

 private:
  double step_db(const detect::WaterfallLine& line, double altitude_m) const;

  detect::FirstBottomSettings settings_;
  detect::BottomTrack track_;
  std::vector<float> amplitude_, all_;
};

}  // namespace ensonify

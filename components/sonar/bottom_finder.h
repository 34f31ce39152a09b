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

  /// Scratch: its contents do not matter.
  struct Memory {
    std::vector<float> amplitude, all;
  };

  /// Fourth stage of a shot. Each beam is judged alone; the track is that of all beams' mean power. `track` is what
  /// pings before found; this ping is added. The envelope is that before any gain, `pulse` what the filter makes of
  /// the echo of a point. Stamp and ping number are left to the caller.
  msg::BottomTrack find(const echo::Image& envelope, const echo::Sampling& sampling, const echo::Pulse& pulse,
                        double sound_speed_mps, detect::BottomTrack& track, Memory& memory) const;

 private:
  detect::FirstBottomSettings settings_;
};

}  // namespace ensonify

#pragma once

#include <vector>

#include "kernels/detect/bottom_track.h"
#include "kernels/echo/image.h"
#include "messages/sonar.h"

namespace ensonify {

/// Where an instrument hears the bottom first, from ping to ping, by its own echoes and its own sound speed.
class BottomFinder {
 public:
  explicit BottomFinder(const detect::FirstBottomSettings& settings) : settings_(settings) {}

  /// The track after one more ping. Each beam is judged alone; the track is that of all beams' mean power. The envelope
  /// is that before any gain. Stamp and ping number are left to the caller.
  msg::BottomTrack find(const echo::Image& envelope, const echo::Sampling& sampling, double sound_speed_mps);

 private:
  double step_db(const detect::WaterfallLine& line, double altitude_m) const;

  detect::FirstBottomSettings settings_;
  detect::BottomTrack track_;
  std::vector<float> amplitude_, all_;
};

}  // namespace ensonify

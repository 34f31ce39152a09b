#pragma once

#include <optional>
#include <string>

#include "kernels/acoustics/trace/scene.h"
#include "kernels/base/frames/pose.h"

namespace ensonify {

/// Height of a head above the seabed straight below it, by the tiles' posts; nothing over a hole, where no tile is held
/// or below the seabed.
std::optional<double> altitude_m(const trace::Scene& seabed, const frames::HeadPose& head);

/// Summary of a ping's trace.
struct TraceSummary {
  int rays_that_hit = 0;             // anything within the range ...
  int rays_in_lobe = 0;              // ... and within 10 dB of the transmit axis
  double range_m = 0.0;              // of reception
  std::optional<double> altitude_m;  // as above
};

/// Reason, for health, that such a ping has no echo; "" when it need not be.
std::string no_echo_reason(const TraceSummary& trace_summary);

}  // namespace ensonify

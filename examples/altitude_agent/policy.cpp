#include "examples/altitude_agent/policy.h"

#include <algorithm>

namespace ensonify {

/// Dives in proportion to what the altitude is too large.
std::optional<msg::Guidance> act(const AltitudeAgentConfig& config, const AltitudeAgentView& view) {
  if (!view.altitude || !view.depth) return std::nullopt;
  const double too_high_m = view.altitude->range_m - config.altitude_m;
  msg::Guidance order;
  order.heading_grid_rad = config.heading_rad;
  order.speed_mps = config.speed_mps;
  order.depth_m = std::max(0.5, view.depth->depth_m + config.gain * too_high_m);
  return order;
}

}  // namespace ensonify

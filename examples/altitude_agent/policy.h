#pragma once

#include <optional>

#include "examples/altitude_agent/config.h"
#include "messages/motion.h"
#include "messages/navigation.h"

namespace ensonify {

/// What the agent knows when it acts.
struct AltitudeAgentView {
  std::optional<msg::Altitude> altitude;  // the last valid one
  std::optional<msg::Depth> depth;
};

/// The order that follows from what is known; nothing until all of it is.
std::optional<msg::Guidance> act(const AltitudeAgentConfig& config, const AltitudeAgentView& view);

}  // namespace ensonify

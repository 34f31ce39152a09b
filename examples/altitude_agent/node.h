#pragma once

#include "components/runtime/ports.h"
#include "examples/altitude_agent/policy.h"

namespace ensonify {

class AltitudeAgentNode {
 public:
  using Config = AltitudeAgentConfig;
  static constexpr const char* kComponent = "altitude_agent";

  AltitudeAgentNode(const Config& config, Ports& ports);

  /// Runs at its own event times, when every input due by `now` has arrived. Returns the next event time.
  SimTime step(SimTime now);

 private:
  Config config_;
  Periodic due_;
  AltitudeAgentView view_;
  Ports::Out<msg::Guidance> commands_;
};

}  // namespace ensonify

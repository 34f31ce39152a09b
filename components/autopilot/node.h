#pragma once

#include <optional>

#include "components/autopilot/pilot.h"
#include "components/runtime/ports.h"
#include "messages/terrain.h"

namespace ensonify {

class AutopilotNode {
 public:
  using Config = AutopilotConfig;
  static constexpr const char* kComponent = "autopilot";

  AutopilotNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

 private:
  AutopilotConfig config_;
  Ports& ports_;
  Periodic commands_due_;
  std::optional<msg::Estimate> estimate_;
  std::optional<msg::Chart> chart_;
  std::optional<Pilot> pilot_;  // empty until the lines are known
  bool finished_ = false;
  Ports::Out<msg::Guidance> commands_;
  Ports::Out<msg::MissionState> missions_;
};

}  // namespace ensonify

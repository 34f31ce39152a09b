#pragma once

#include <map>
#include <optional>
#include <string>

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
  /// 1 for a mission that was given up, unless the user takes that for an end.
  int exit_code() const;

 private:
  void check_settings();
  void report_health(SimTime now);
  bool another_steers() const;

  AutopilotConfig config_;
  Ports& ports_;
  Periodic commands_due_;
  std::optional<msg::Estimate> estimate_;
  std::optional<msg::Chart> chart_;
  std::optional<msg::Helm> helm_;
  std::optional<msg::Altitude> altitude_;  // received since the last command
  std::optional<Pilot> pilot_;             // empty until the lines are known
  bool checked_ = false, finished_ = false;
  Ports::Out<msg::Guidance> commands_;
  Ports::Out<msg::MissionState> missions_;
  std::map<std::string, Ports::Out<msg::SonarSettings>> settings_;  // by head
  std::optional<Ports::Out<msg::Mark>> marks_;
};

}  // namespace ensonify

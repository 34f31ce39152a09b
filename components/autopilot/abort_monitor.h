#pragma once

#include <optional>
#include <string>

#include "components/autopilot/headway.h"
#include "components/runtime/sim_time.h"
#include "messages/navigation.h"
#include "scenarios/world/mission.h"

namespace ensonify {

/// States when a mission is to be given up: by its own rules, or because the vehicle comes no nearer to its goal.
class AbortMonitor {
 public:
  /// `patience_s` as Headway has it.
  AbortMonitor(const AbortRules& rules, double patience_s) : rules_(rules), headway_(patience_s) {}

  /// Whether the vehicle is below the obstacle floor now.
  void observe(SimTime now, bool too_low);
  /// The way to the goal now; nothing: there is none to come nearer to.
  void go(SimTime now, std::optional<double> to_go_m, bool another_goal);

  /// Reason that the mission is to be given up; empty: it is not.
  std::string why(SimTime now, const msg::Estimate& estimate) const;
  bool held_up(SimTime now) const { return headway_.held_up(now); }

 private:
  AbortRules rules_;
  Headway headway_;
  std::optional<SimTime> too_low_since_;
};

}  // namespace ensonify

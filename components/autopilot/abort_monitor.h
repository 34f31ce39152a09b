#pragma once

#include <optional>
#include <string>

#include "components/runtime/sim_time.h"
#include "messages/navigation.h"
#include "scenarios/world/mission.h"

namespace ensonify {

/// Whether a vehicle still comes nearer to where it should go. One that faces a current as fast as itself does
/// not, and would be under way for ever.
class Headway {
 public:
  /// A metre within `patience_s` is headway; 0: every vehicle is waited for.
  explicit Headway(double patience_s) : patience_s_(patience_s) {}

  /// Another goal, or nothing to go to.
  void start_anew() { nearest_m_.reset(); }
  /// The way to go now. A way that had to be begun again counts from the nearest that the vehicle ever was.
  void observe(SimTime now, double to_go_m);

  bool held_up(SimTime now) const { return none_for(now, 0.1 * patience_s_); }
  bool lost(SimTime now) const { return none_for(now, patience_s_); }

 private:
  bool none_for(SimTime now, double time_s) const {
    return time_s > 0.0 && nearest_m_ && seconds(now - nearest_at_) >= time_s;
  }

  double patience_s_;
  std::optional<double> nearest_m_;
  SimTime nearest_at_{0};
};

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

#pragma once

#include <string>

#include "scenarios/world/auto_plan.h"

namespace ensonify {

class ConfigReader;

struct AutopilotConfig {
  int command_rate_hz = 10;
  double lookahead_radii = 1.5;      // line-of-sight distance in turning radii; smaller steers harder
  double turn_margin = 1.2;          // planned turns are this much wider than the vehicle's turning circle
  double turn_speed_fraction = 1.0;  // speed in turns, of the mission's
  double drift_settle_s = 10.0;      // time constant with which the drift is learned; 0: none, and no integral
  double patience_s = 600.0;         // a vehicle that comes no metre nearer for so long gives up; 0: never

  // From the scenario.
  MissionPlan plan;

  static AutopilotConfig read(ConfigReader& from, const World& world, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const AutopilotConfig& other) const {
    return command_rate_hz == other.command_rate_hz && lookahead_radii == other.lookahead_radii &&
           turn_margin == other.turn_margin && turn_speed_fraction == other.turn_speed_fraction &&
           drift_settle_s == other.drift_settle_s && patience_s == other.patience_s;
  }
};

}  // namespace ensonify

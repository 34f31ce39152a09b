#pragma once

#include <optional>
#include <string>

#include "components/runtime/mission/auto_plan.h"

namespace ensonify {

class ConfigReader;

struct VehicleConfig {
  int pose_rate_hz = 100;

  // From the scenario.
  motion::Limits limits;
  double fastest_mps = 10.0;
  motion::Waves waves;
  std::optional<motion::State> start;  // not given: at the first line's run-in
  MissionPlan plan;

  static VehicleConfig read(ConfigReader& from, const Scenario& scenario, const std::string& process);
  /// Where the vehicle starts is known only when the chart is.
  bool needs_chart() const { return !start && plan.needs_chart(); }
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const VehicleConfig& other) const { return pose_rate_hz == other.pose_rate_hz; }
};

}  // namespace ensonify

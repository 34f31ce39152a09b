#pragma once

#include <vector>

#include "messages/terrain.h"
#include "scenarios/world/world.h"

namespace ensonify {

/// Part of the scenario that determines the survey lines.
struct MissionPlan {
  std::string scenario_file;
  Mission mission;
  motion::Limits limits;  // of the vehicle that runs them

  static MissionPlan of(const World& world, const Vehicle& vehicle);
  /// The lines are known only when the chart is.
  bool needs_chart() const { return mission.auto_plan.has_value(); }
};

/// The survey lines in order: the scenario's own, or for `auto` laid over the chart. Whoever asks with the same
/// scenario and chart gets the same lines. Throws ConfigError naming mission.auto when the chart has no room for them.
std::vector<runlines::Runline> planned_lines(const MissionPlan& plan, const msg::Chart& chart);

/// Start of a vehicle without a place: at the start of the first line's run-in, on its way at mission speed.
motion::State start_of(const MissionPlan& plan, const std::vector<runlines::Runline>& lines);

}  // namespace ensonify

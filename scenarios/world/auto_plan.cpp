#include "scenarios/world/auto_plan.h"

#include <filesystem>

#include "components/config/config_error.h"
#include "components/config/config_node.h"
#include "components/errors/assert.h"
#include "kernels/vehicle/runlines/survey_plan.h"

namespace ensonify {
namespace {

/// Of `mission: { auto: }` in a scenario's file. What stands elsewhere, as a launch file may say it, has the file
/// alone.
ConfigPlace place_of_auto(const std::string& scenario_file) {
  const ConfigPlace file{scenario_file, 0, 0};
  if (!std::filesystem::is_regular_file(scenario_file)) return file;
  const ConfigNode world = parse_config_file(scenario_file).root;
  const ConfigNode* mission = world.find("mission");
  const ConfigNode* wanted = mission != nullptr ? mission->find("auto") : nullptr;
  return wanted != nullptr ? wanted->place : file;
}

}  // namespace

MissionPlan MissionPlan::of(const World& world, const Vehicle& vehicle) {
  return {world.file, world.mission, vehicle.limits};
}

std::vector<runlines::Runline> planned_lines(const MissionPlan& plan, const msg::Chart& chart) {
  const Mission& mission = plan.mission;
  if (!mission.auto_plan) return mission.runlines;
  const AutoPlan& wanted = *mission.auto_plan;

  runlines::HeightGrid ground;
  ground.west_m = chart.west_m;
  ground.south_m = chart.south_m;
  ground.spacing_m = chart.spacing_m;
  ground.columns = chart.height_m.cols();
  ground.rows = chart.height_m.rows();
  ground.height_m = chart.height_m.flat();

  runlines::SurveyRequest request;
  request.most_lines = wanted.count;
  request.longest_line_m = wanted.longest_m;
  request.swath_rad = wanted.swath_rad;
  request.overlap = wanted.overlap;
  request.spacing_m = wanted.spacing_m;
  request.heading_rad = wanted.heading_rad;
  request.head_height_m = -mission.depth_m;
  request.run_in_m = mission.run_in_m;
  request.turn_room_m = mission.run_in_m + 2.0 * plan.limits.turning_radius_m;
  try {
    return runlines::plan_survey(ground, request).lines;
  } catch (const runlines::NoRoom& no_room) {
    throw ConfigError(
        {{place_of_auto(plan.scenario_file), "mission.auto", std::string("no room for a survey: ") + no_room.what()}});
  }
}

motion::State start_of(const MissionPlan& plan, const std::vector<runlines::Runline>& lines) {
  ENSONIFY_ASSERT(!lines.empty(), "a mission has at least one line");
  const frames::Vec2 start = runlines::extended(lines.front(), plan.mission.run_in_m, 0.0).start_enu_m;
  return {{start.x(), start.y(), -plan.mission.depth_m}, runlines::heading_rad(lines.front()), plan.mission.speed_mps};
}

}  // namespace ensonify

#include "components/runtime/mission/auto_plan.h"

#include "components/runtime/assert.h"
#include "components/runtime/config/config_error.h"
#include "kernels/navigation/survey_plan.h"

namespace ensonify {

MissionPlan MissionPlan::of(const Scenario& scenario, const Vehicle& vehicle) {
  return {scenario.file, scenario.mission, vehicle.limits};
}

std::vector<navigation::Runline> runlines(const MissionPlan& plan, const msg::Chart& chart) {
  const Mission& mission = plan.mission;
  if (!mission.auto_plan) return mission.runlines;
  const AutoPlan& wanted = *mission.auto_plan;

  navigation::HeightGrid ground;
  ground.west_m = chart.west_m;
  ground.south_m = chart.south_m;
  ground.spacing_m = chart.spacing_m;
  ground.columns = chart.height_m.cols();
  ground.rows = chart.height_m.rows();
  ground.height_m = chart.height_m.flat();

  navigation::SurveyWish wish;
  wish.most_lines = wanted.count;
  wish.longest_line_m = wanted.longest_m;
  wish.swath_rad = wanted.swath_rad;
  wish.overlap = wanted.overlap;
  wish.spacing_m = wanted.spacing_m;
  wish.heading_rad = wanted.heading_rad;
  wish.head_height_m = -mission.depth_m;
  wish.run_in_m = mission.run_in_m;
  wish.turn_room_m = mission.run_in_m + 2.0 * plan.limits.turning_radius_m;
  try {
    return navigation::plan_survey(ground, wish).lines;
  } catch (const navigation::NoRoom& no_room) {
    throw ConfigError(
        {{{plan.scenario_file, 0, 0}, "mission.auto", std::string("no room for a survey: ") + no_room.what()}});
  }
}

motion::State start_of(const MissionPlan& plan, const std::vector<navigation::Runline>& lines) {
  ENSONIFY_ASSERT(!lines.empty(), "a mission has at least one line");
  const frames::Vec2 start = navigation::extended(lines.front(), plan.mission.run_in_m, 0.0).start_enu_m;
  return {
      {start.x(), start.y(), -plan.mission.depth_m}, navigation::heading_rad(lines.front()), plan.mission.speed_mps};
}

}  // namespace ensonify

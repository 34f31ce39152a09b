#include "tools/console/plan.h"

#include "components/config/config_error.h"
#include "components/config/config_reader.h"
#include "components/config/parse_yaml.h"
#include "scenarios/world/world.h"

namespace ensonify::console {

namespace {
constexpr std::size_t kMostMarks = 1000;
constexpr std::size_t kNumbers = 4;  // of a line
}  // namespace

void Plan::read(const std::string& scenario) {
  lines_enu_m_.clear();
  to_lay_ = scenario;
  lay();
}

void Plan::take(const msg::Chart& chart) {
  chart_ = chart;
  if (!to_lay_.empty()) lay();
}

/// As the autopilot does, by the same code.
void Plan::lay() {
  std::vector<runlines::Runline> lines;
  try {
    ConfigReader from(parse_config(to_lay_, "scenario.yaml"));
    const World world = read_world(from, "scenario.yaml");
    if (!world.mission.auto_plan) {
      lines = world.mission.runlines;
    } else if (!chart_) {
      return;
    } else if (world.vehicles.size() == 1) {
      lines = planned_lines(MissionPlan::of(world, world.vehicles.front()), *chart_);
    }
  } catch (const ConfigError&) {
    // Of another version, with files that are not here, or without room for a survey: the chart shows no plan.
  }
  for (const runlines::Runline& line : lines)
    lines_enu_m_.insert(lines_enu_m_.end(),
                        {line.start_enu_m.x(), line.start_enu_m.y(), line.end_enu_m.x(), line.end_enu_m.y()});
  planned_ = lines_enu_m_.size() / kNumbers;
  to_lay_.clear();
  chart_.reset();
}

/// The first line of an adaptive survey is the scenario's.
void Plan::take(const msg::NextLine& next) {
  if (next.done || next.number < static_cast<std::int64_t>(planned_)) return;
  lines_enu_m_.insert(lines_enu_m_.end(),
                      {next.start_enu_m[0], next.start_enu_m[1], next.end_enu_m[0], next.end_enu_m[1]});
}

void Plan::take(const msg::Mark& mark) {
  if (marks_.size() < kMostMarks) marks_.push_back({mark.text, {mark.position_enu_m[0], mark.position_enu_m[1]}});
}

msg::ConsolePlan Plan::message() const {
  msg::ConsolePlan plan;
  plan.line_enu_m = msg::Array<double>({lines_enu_m_.size() / kNumbers, kNumbers});
  std::copy(lines_enu_m_.begin(), lines_enu_m_.end(), plan.line_enu_m.flat().begin());
  plan.marks = marks_;
  return plan;
}

}  // namespace ensonify::console

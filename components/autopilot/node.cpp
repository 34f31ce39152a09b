#include "components/autopilot/node.h"

#include <algorithm>

#include "components/errors/exit_error.h"
#include "components/runtime/declared.h"
#include "components/runtime/log.h"

namespace ensonify {

AutopilotNode::AutopilotNode(const Config& config, Ports& ports)
    : config_(config),
      ports_(ports),
      commands_due_(Rate{config.command_rate_hz, 1}),
      commands_(ports.out<msg::Guidance>("command", {.rate = Rate{config.command_rate_hz, 1}})),
      missions_(ports.out<msg::MissionState>("mission", {.rate = Rate{config.command_rate_hz, 1}})) {
  ports.may_finish();
  ports.in<msg::Estimate>("estimate", [this](const msg::Estimate& estimate) { estimate_ = estimate; });
  ports.in<msg::Helm>("helm", [this](const msg::Helm& helm) { helm_ = helm; }, {.optional = true});
  if (config.plan.needs_chart()) {
    ports.in<msg::Chart>("chart", [this](const msg::Chart& chart) { chart_ = chart; });
  } else {
    pilot_.emplace(config, config.plan.mission.steps);
  }
  const Mission& mission = config.plan.mission;
  const Rate rate{config.command_rate_hz, 1};
  if (DepthKeeper(mission, config.plan.limits.vertical_speed_mps).steers()) {
    ports.in<msg::Altitude>("altitude", [this](const msg::Altitude& altitude) { altitude_ = altitude; },
                            {.optional = !needs_altimeter(mission)});
  }
  if (mission.adaptive) {
    ports.in<msg::NextLine>("next_line", [this](const msg::NextLine& line) { pilot_->offer(line); });
  }
  for (const std::string& head : mission.sonars()) {
    settings_.emplace(head, ports.out<msg::SonarSettings>("settings_" + head, {.rate = rate}));
  }
  if (std::any_of(mission.steps.begin(), mission.steps.end(),
                  [](const MissionStep& step) { return std::holds_alternative<SetMark>(step); })) {
    marks_ = ports.out<msg::Mark>("mark", {.rate = rate});
  }
}

/// What heads declare is known when time starts.
void AutopilotNode::check_settings() {
  checked_ = true;
  const auto problems = setting_problems(config_.plan.mission, declared<msg::HeadDeclaration>(ports_.facts()));
  if (!problems.empty()) throw ConfigError(problems);
}

SimTime AutopilotNode::step(SimTime now) {
  if (!checked_) check_settings();
  if (!commands_due_.due(now)) return commands_due_.next();
  if (!pilot_ && chart_) pilot_.emplace(config_, steps_of(planned_lines(config_.plan, *chart_)));
  if (pilot_ && estimate_) {
    if (altitude_) pilot_->take_altitude(*altitude_);
    altitude_.reset();
    if (another_steers()) {
      pilot_->stand_by(now, *estimate_);
    } else {
      pilot_->take_over(now, helm_ && helm_->why == "silent");
      pilot_->update(now, *estimate_);
    }
    commands_.send(pilot_->command(now));
    missions_.send(pilot_->mission_state(now));
    for (const auto& [head, settings] : pilot_->take_settings()) settings_.at(head).send(settings);
    for (const msg::Mark& mark : pilot_->take_marks()) marks_->send(mark);
    report_health(now);
    if (pilot_->ended() && !finished_) {
      finished_ = true;
      if (!pilot_->given_up().empty()) log::event(ports_, "gave_up", "why=\"{}\"", pilot_->given_up());
      ports_.finish();
    }
  }
  return commands_due_.next();
}

/// Of the vehicle that this process may steer; another one's helm is none of its business.
bool AutopilotNode::another_steers() const {
  const auto is_me = [&](const std::string& name) { return name == ports_.process(); };
  return helm_ && !helm_->steered_by.empty() && !is_me(helm_->steered_by) && std::ranges::any_of(helm_->pilots, is_me);
}

int AutopilotNode::exit_code() const {
  const bool failed = config_.giving_up_fails && pilot_ && !pilot_->given_up().empty();
  return failed ? kExitAssertionFailed : kExitOk;
}

void AutopilotNode::report_health(SimTime now) {
  if (!pilot_->given_up().empty()) return ports_.health("failed", "mission given up: " + pilot_->given_up());
  if (pilot_->held_up(now))
    return ports_.health("degraded",
                         "no metre nearer to the goal in a tenth of patience_s: a current as fast as the vehicle?");
  if (pilot_->bottom_lost(now))
    return ports_.health("degraded", "no bottom detected for 10 s: neither altitude_m nor least_altitude_m is kept");
  ports_.health("ok", "");
}

}  // namespace ensonify

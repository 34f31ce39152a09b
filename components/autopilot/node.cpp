#include "components/autopilot/node.h"

namespace ensonify {

AutopilotNode::AutopilotNode(const Config& config, Ports& ports)
    : config_(config),
      ports_(ports),
      commands_due_(Rate{config.command_rate_hz, 1}),
      commands_(ports.out<msg::Guidance>("command", {.rate = Rate{config.command_rate_hz, 1}})),
      missions_(ports.out<msg::MissionState>("mission", {.rate = Rate{config.command_rate_hz, 1}})) {
  ports.may_finish();
  ports.in<msg::Estimate>("estimate", [this](const msg::Estimate& estimate) { estimate_ = estimate; });
  if (config.plan.needs_chart()) {
    ports.in<msg::Chart>("chart", [this](const msg::Chart& chart) { chart_ = chart; });
  } else {
    pilot_.emplace(config, config.plan.mission.runlines);
  }
}

SimTime AutopilotNode::step(SimTime now) {
  if (!commands_due_.due(now)) return commands_due_.next();
  if (!pilot_ && chart_) pilot_.emplace(config_, runlines(config_.plan, *chart_));
  if (pilot_ && estimate_) {
    pilot_->update(*estimate_);
    commands_.send(pilot_->command(now));
    missions_.send(pilot_->mission_state(now));
    if (pilot_->state() == Pilot::State::kDone && !finished_) {
      finished_ = true;
      ports_.finish();
    }
  }
  return commands_due_.next();
}

}  // namespace ensonify

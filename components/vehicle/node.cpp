#include "components/vehicle/node.h"

#include "components/runtime/log.h"
#include "components/tracks/followed_track.h"

namespace ensonify {
namespace {

constexpr SimTime kReaction = 100_ms;  // from a command to its effect; also breaks the wiring's cycle through the pilot
constexpr Rate kHelmRate{1, 1};

}  // namespace

VehicleNode::VehicleNode(const Config& config, Ports& ports)
    : config_(config),
      ports_(ports),
      poses_due_(Rate{config.pose_rate_hz, 1}),
      helm_due_(kHelmRate),
      pilots_(config.steered_by.empty() ? std::vector<PilotKeys>{PilotKeys{}} : config.steered_by),
      poses_(ports.out<msg::Pose>("pose", {.rate = Rate{config.pose_rate_hz, 1}})) {
  if (config.followed) ports.may_finish();
  else declare_command();
  if (config.needs_chart()) {
    ports.in<msg::Chart>("chart", [this](const msg::Chart& chart) { chart_ = chart; }, {.delay = kReaction});
  }
}

/// One input for whoever the wiring names, or for the pilots that the configuration has.
void VehicleNode::declare_command() {
  if (config_.steered_by.empty()) {
    ports_.in<msg::Guidance>("command", [this](const msg::Guidance& guidance) { take("", guidance); },
                             {.delay = kReaction, .optional = true});
    if (config_.hydrodynamics) {
      ports_.in<msg::Actuators>("actuators", [this](const msg::Actuators& order) { take("", order); },
                                {.delay = kReaction, .optional = true});
    }
    return;
  }
  std::vector<std::string> commands, actuators;
  for (const PilotKeys& pilot : config_.steered_by) {
    if (pilot.by == PilotKeys::By::kCommand) commands.push_back(pilot.name + "/command");
    else actuators.push_back(pilot.name + "/actuators");
  }
  if (!commands.empty()) {
    ports_.in_topics<msg::Guidance>(
        "command", commands, [this](const std::string& pilot, const msg::Guidance& guidance) { take(pilot, guidance); },
        {.delay = kReaction});
  }
  if (!actuators.empty()) {
    ports_.in_topics<msg::Actuators>(
        "actuators", actuators, [this](const std::string& pilot, const msg::Actuators& order) { take(pilot, order); },
        {.delay = kReaction});
  }
  // At most one a pose, when it changes hands.
  helms_ = ports_.out<msg::Helm>("helm", {.rate = Rate{config_.pose_rate_hz, 1}});
}

void VehicleNode::take(const std::string& pilot, const msg::Guidance& guidance) {
  const std::string refusal = refusal_of(guidance, config_.name);
  if (!refusal.empty()) return refuse(pilot, refusal);
  pilots_.take(ports_.now(), pilot, guidance);
}

void VehicleNode::take(const std::string& pilot, const msg::Actuators& order) {
  const std::string refusal = refusal_of(order, config_.name, config_.hydrodynamics->body);
  if (!refusal.empty()) return refuse(pilot, refusal);
  pilots_.take(ports_.now(), pilot, order);
}

void VehicleNode::refuse(const std::string& pilot, const std::string& refusal) {
  if (refused_++ == 0) log::event(ports_, "refused", "what={}{}", refusal, pilot.empty() ? "" : " pilot=" + pilot);
  ports_.count("commands_" + refusal);
  ports_.health("degraded", (pilot.empty() ? "a command" : "a command of " + pilot) + " was refused: " + refusal);
}

SimTime VehicleNode::step(SimTime now) {
  if (!poses_due_.due(now)) return poses_due_.next();
  if (!vehicle_ && config_.start) vehicle_.emplace(config_, *config_.start, now);
  if (!vehicle_ && chart_) vehicle_.emplace(config_, start_of(config_.plan, planned_lines(config_.plan, *chart_)), now);
  report_helm(now);
  const auto command = pilots_.take_command();
  if (vehicle_) {
    vehicle_->advance(now);
    if (command) vehicle_->obey(*command);
    poses_.send(vehicle_->pose());
  }
  if (config_.followed && !finished_ && seconds(now) >= config_.followed->end_s()) {
    finished_ = true;
    log::event(ports_, "followed", "to_s={:.3f}", seconds(now));
    ports_.finish();
  }
  return poses_due_.next();
}

/// Each second, and when it changes hands.
void VehicleNode::report_helm(SimTime now) {
  const bool changed = pilots_.update(now), due = helm_due_.due(now);
  if (!helms_ || !(changed || due)) return;
  msg::Helm helm{now.count(), pilots_.steered_by(), {}, pilots_.why(), refused_};
  for (const PilotKeys& pilot : config_.steered_by) helm.pilots.push_back(pilot.name);
  helms_->send(helm);
  if (changed) {
    log::event(ports_, "helm", "steered_by={} why={}", pilots_.steered_by().empty() ? "nobody" : pilots_.steered_by(),
               pilots_.why());
  }
}

}  // namespace ensonify

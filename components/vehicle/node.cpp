#include "components/vehicle/node.h"

#include <cmath>

#include "components/errors/assert.h"

namespace ensonify {
namespace {

constexpr SimTime kReaction = 100_ms;  // from a command to its effect; also breaks the wiring's cycle through the pilot

}  // namespace

VehicleNode::VehicleNode(const Config& config, Ports& ports)
    : config_(config),
      ports_(ports),
      poses_due_(Rate{config.pose_rate_hz, 1}),
      poses_(ports.out<msg::Pose>("pose", {.rate = Rate{config.pose_rate_hz, 1}})) {
  ports.in<msg::Guidance>("command", [this](const msg::Guidance& guidance) { command_ = guidance; },
                          {.delay = kReaction, .optional = true});
  if (config.needs_chart()) {
    ports.in<msg::Chart>("chart", [this](const msg::Chart& chart) { chart_ = chart; }, {.delay = kReaction});
  }
}

SimTime VehicleNode::step(SimTime now) {
  if (!poses_due_.due(now)) return poses_due_.next();
  if (!vehicle_ && config_.start) vehicle_.emplace(config_, *config_.start, now);
  if (!vehicle_ && chart_) vehicle_.emplace(config_, start_of(config_.plan, planned_lines(config_.plan, *chart_)), now);
  if (vehicle_) {
    vehicle_->advance(now);
    if (command_ && !std::isinf(command_->depth_m)) {  // it may be NaN; no other field may, and none arrives so
      vehicle_->command(*command_);
    } else if (command_) {
      ports_.count("commands_not_finite");
    }
    poses_.send(vehicle_->pose());
  }
  command_.reset();
  return poses_due_.next();
}

}  // namespace ensonify

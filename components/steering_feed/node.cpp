#include "components/steering_feed/node.h"

#include <string>
#include <string_view>

#include "kernels/vehicle/guidance/laws.h"

namespace ensonify {
namespace {

constexpr double kDriftSettles_s = 10.0;

}  // namespace

SteeringFeedNode::SteeringFeedNode(const Config& config, Ports& ports)
    : config_(config),
      ports_(ports),
      commands_due_(Rate{config.command_rate_hz, 1}),
      course_(config, [this](const std::string& what) { ports_.count(what); }),
      commands_(ports.out<msg::Guidance>("command", {.rate = Rate{config.command_rate_hz, 1}})),
      input_(ports, config.sources, config.recorded, Rate{config.command_rate_hz, 1}),
      lines_(config.sources.size()) {
  ports.in<msg::Estimate>("estimate", [this](const msg::Estimate& estimate) { estimate_ = estimate; });
  if (config.origin) {
    world_.emplace(*config.origin);
  } else {
    ports.in<msg::Chart>("chart", [this](const msg::Chart& chart) {
      world_.emplace(frames::Geodetic{chart.origin_latitude_deg, chart.origin_longitude_deg});
    });
  }
}

SimTime SteeringFeedNode::step(SimTime now) {
  if (!commands_due_.due(now)) return commands_due_.next();
  input_.open();
  receive(now);
  if (!estimate_ || !world_) return commands_due_.next();
  const frames::Vec2 velocity_mps(estimate_->velocity_enu_mps[0], estimate_->velocity_enu_mps[1]);
  const double heading_rad = frames::attitude_of(frames::quaternion_of(estimate_->enu_from_body)).heading_rad;
  drift_enu_mps_ =
      guidance::learn_drift(drift_enu_mps_, velocity_mps, heading_rad, 1.0 / config_.command_rate_hz, kDriftSettles_s);
  const auto order = course_.order(now, velocity_mps.norm());
  if (!order) {
    const std::string trouble = input_.trouble();
    ports_.health("degraded", trouble.empty() ? "no sentence that orders a heading or a leg" : trouble);
    return commands_due_.next();
  }
  ports_.health("ok", "");
  msg::Guidance guidance;
  guidance.stamp_ns = now.count();
  guidance.heading_grid_rad = heading_grid_rad(*order);
  guidance.speed_mps = config_.speed_mps;
  if (config_.depth_m) guidance.depth_m = *config_.depth_m;
  commands_.send(guidance);
  return commands_due_.next();
}

/// A course is made good against the drift.
double SteeringFeedNode::heading_grid_rad(const OrderedCourse::Order& order) const {
  const frames::Vec2 place(estimate_->position_enu_m[0], estimate_->position_enu_m[1]);
  const double grid_rad = order.true_rad - world_->convergence_rad(place);
  if (order.is_heading) return frames::wrap_two_pi(grid_rad);
  return frames::wrap_two_pi(guidance::heading_for_course_rad(grid_rad, config_.speed_mps, drift_enu_mps_));
}

void SteeringFeedNode::receive(SimTime now) {
  for (const FedPiece& piece : input_.take(now)) {
    lines_[piece.source].take(
        piece.bytes, piece.begins, piece.whole, [&](std::string_view line) { course_.take(line, now); },
        [this] { ports_.count("lines_too_long"); });
  }
}

}  // namespace ensonify

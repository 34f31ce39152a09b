#include "components/steering_feed/node.h"

#include "components/errors/exit_error.h"
#include "kernels/vehicle/guidance/laws.h"

namespace ensonify {
namespace {

constexpr int kMostDatagrams = 1000;  // at an event: a flood must not stop the run
constexpr double kDriftSettles_s = 10.0;

}  // namespace

SteeringFeedNode::SteeringFeedNode(const Config& config, Ports& ports)
    : config_(config),
      ports_(ports),
      commands_due_(Rate{config.command_rate_hz, 1}),
      course_(config, [this](const std::string& what) { ports_.count(what); }),
      commands_(ports.out<msg::Guidance>("command", {.rate = Rate{config.command_rate_hz, 1}})) {
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
  if (!receiver_) listen();
  receive(now);
  if (!estimate_ || !world_) return commands_due_.next();
  const frames::Vec2 velocity_mps(estimate_->velocity_enu_mps[0], estimate_->velocity_enu_mps[1]);
  const double heading_rad = frames::attitude_of(frames::quaternion_of(estimate_->enu_from_body)).heading_rad;
  drift_enu_mps_ =
      guidance::learn_drift(drift_enu_mps_, velocity_mps, heading_rad, 1.0 / config_.command_rate_hz, kDriftSettles_s);
  const auto order = course_.order(now, velocity_mps.norm());
  if (!order) {
    ports_.health("degraded", "no sentence that orders a heading or a leg");
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

void SteeringFeedNode::listen() {
  const std::string here = "127.0.0.1";
  try {
    receiver_.emplace(udp_channel(here, config_.port, Senders({here})));
  } catch (const UserError& error) {
    throw UserError(std::string("port: ") + error.what());
  }
}

void SteeringFeedNode::receive(SimTime now) {
  for (int i = 0; i < kMostDatagrams; ++i) {
    const auto arrival = receiver_->take();
    if (!arrival) break;
    course_.take(arrival->piece.bytes, now);
  }
  const Receiver::State state = receiver_->state();
  const auto grown = [&](const char* what, std::uint64_t total, std::uint64_t& before) {
    if (total > before) ports_.count(what, static_cast<std::int64_t>(total - before));
    before = total;
  };
  grown("senders_refused", state.refused, refused_);
  grown("bytes_dropped", state.dropped_bytes, dropped_bytes_);
}

}  // namespace ensonify

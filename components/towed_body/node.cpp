#include "components/towed_body/node.h"

#include "components/truth/pose_message.h"

namespace ensonify {
namespace {

constexpr SimTime kFixDelay = 100_ms;  // also breaks the wiring's cycle through who finds the body by USBL

frames::Vec3 vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

TowedBodyNode::TowedBodyNode(const Config& config, Ports& ports)
    : config_(config),
      ports_(ports),
      poses_due_(Rate{config.pose_rate_hz, 1}),
      period_s_(1.0 / config.pose_rate_hz),
      disturbance_(config.disturbance, random::Stream(config.seed, "vehicle/" + config.name + "/disturbance")),
      estimator_(config),
      poses_(ports.out<msg::Pose>("pose", {.rate = Rate{config.pose_rate_hz, 1}})),
      estimates_(ports.out<msg::Estimate>("estimate", {.rate = Rate{config.pose_rate_hz, 1}})) {
  ports.in<msg::Pose>("vessel", [this](const msg::Pose& pose) { vessel_ = pose; });
  ports.in<msg::Estimate>("vessel_estimate", [this](const msg::Estimate& estimate) { estimator_.take(estimate); },
                          {.optional = true});
  if (config.positioning.by == TowPositioning::By::kUsbl) {
    ports.in<msg::UsblFix>("usbl", [this](const msg::UsblFix& fix) { estimator_.take(fix); }, {.delay = kFixDelay});
  }
}

SimTime TowedBodyNode::step(SimTime now) {
  const auto n = static_cast<std::uint64_t>(poses_due_.count());
  if (!poses_due_.due(now)) return poses_due_.next();
  if (!vessel_) return poses_due_.next();
  tow();
  const frames::MovingPose body = moving(now);
  poses_.send(pose_message(now, body));
  if (const auto estimate = estimator_.estimate(now, n, body.pose)) estimates_.send(*estimate);
  return poses_due_.next();
}

void TowedBodyNode::tow() {
  const frames::Pose vessel{vec(vessel_->position_enu_m), frames::quaternion_of(vessel_->enu_from_body)};
  const frames::Vec3 sheave_enu_m = frames::enu_from_body(vessel, vec(config_.sheave_m));
  const double t_s = seconds(SimTime{vessel_->stamp_ns});
  if (!body_) {  // the vessel has gone straight on for long
    const frames::Vec2 current = config_.current.velocity_enu_mps(0.0, t_s);
    const frames::Vec3 velocity = vec(vessel_->velocity_enu_mps);
    const double heading_rad = frames::attitude_of(vessel.enu_from_body).heading_rad;
    body_ = motion::towed_behind(config_.cable, config_.body, sheave_enu_m, heading_rad,
                                 (velocity.head<2>() - current).norm());
    velocity_enu_mps_ = {velocity.x(), velocity.y(), 0.0};
    return;
  }
  const motion::TowState before = *body_;
  const frames::Vec2 current = config_.current.velocity_enu_mps(-before.position_enu_m.z(), t_s);
  body_ = motion::tow(config_.cable, config_.body, before, sheave_enu_m, current, config_.depth_lag_s, period_s_);
  const frames::Vec3 velocity = (body_->position_enu_m - before.position_enu_m) / period_s_;
  acceleration_enu_mps2_ = (velocity - velocity_enu_mps_) / period_s_;
  velocity_enu_mps_ = velocity;
  turn_rate_radps_ = frames::wrap_pi(body_->heading_rad - before.heading_rad) / period_s_;
}

frames::MovingPose TowedBodyNode::moving(SimTime now) const {
  frames::MovingPose moving;
  moving.pose = {body_->position_enu_m, frames::enu_from_body({body_->heading_rad, 0.0, 0.0})};
  moving.velocity_enu_mps = velocity_enu_mps_;
  moving.acceleration_enu_mps2 = acceleration_enu_mps2_;
  moving.angular_rate_body_radps = {0.0, 0.0, turn_rate_radps_};
  return motion::superimpose(moving, disturbance_.at(seconds(now)));
}

}  // namespace ensonify

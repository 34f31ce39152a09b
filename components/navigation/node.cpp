#include "components/navigation/node.h"

#include <algorithm>

#include "messages/terrain.h"

namespace ensonify {
namespace {

std::array<double, 3> plain(const frames::Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

NavigationNode::NavigationNode(const Config& config, Ports& ports)
    : sensors_(config),
      filter_(config.position_gain),
      attitude_due_(Rate{config.attitude_rate_hz, 1}),
      position_due_(Rate{config.position_rate_hz, 1}),
      sound_speed_due_(Rate{config.probe.rate_hz, 1}),
      motion_latency_(from_seconds(config.motion_latency_s)),
      sound_speed_latency_(from_seconds(config.probe.latency_s)),
      attitudes_(ports.out<msg::Attitude>("attitude", {.rate = Rate{config.attitude_rate_hz, 1}})),
      positions_(ports.out<msg::Position>("position", {.rate = Rate{config.position_rate_hz, 1}})),
      sound_speeds_(ports.out<msg::SoundSpeed>("sound_speed", {.rate = Rate{config.probe.rate_hz, 1}})),
      estimates_(ports.out<msg::Estimate>("estimate", {.rate = Rate{config.attitude_rate_hz, 1}})) {
  if (config.origin) world_.emplace(*config.origin);
  ports.in<msg::Pose>("pose", [this](const msg::Pose& pose) {
    truth_ = pose;
    recent_.push_back(pose);
    const std::int64_t old_ns = pose.stamp_ns - motion_latency_.count();
    while (recent_.size() > 1 && recent_[1].stamp_ns <= old_ns) recent_.pop_front();
  });
  if (!world_) {
    ports.in<msg::Chart>("chart", [this](const msg::Chart& chart) {
      world_.emplace(frames::Geodetic{chart.origin_latitude_deg, chart.origin_longitude_deg});
    });
  }
}

SimTime NavigationNode::step(SimTime now) {
  const std::int64_t sample = attitude_due_.count(), fix = position_due_.count();
  const bool attitude = attitude_due_.due(now), position = position_due_.due(now);
  if (truth_ && world_) {
    if (attitude) filter_.predict(SimTime{truth_->stamp_ns}, sensors_.velocity_enu_mps(moved(), sample));
    if (position) measure_position(fix);
    if (attitude) estimate(sensors_.attitude(moved(), sample));
  }
  const std::int64_t dip = sound_speed_due_.count();
  if (sound_speed_due_.due(now) && truth_) {
    sound_speeds_under_way_.emplace_back(now + sound_speed_latency_, sensors_.sound_speed(*truth_, dip));
  }
  report_sound_speed(now);
  const SimTime next = std::min({attitude_due_.next(), position_due_.next(), sound_speed_due_.next()});
  return sound_speeds_under_way_.empty() ? next : std::min(next, sound_speeds_under_way_.front().first);
}

/// What the motion sensor measures now: the pose of its latency ago, with the newest stamp.
msg::Pose NavigationNode::moved() const {
  msg::Pose pose = recent_.front();
  pose.stamp_ns = truth_->stamp_ns;
  return pose;
}

void NavigationNode::report_sound_speed(SimTime now) {
  while (!sound_speeds_under_way_.empty() && sound_speeds_under_way_.front().first <= now) {
    sound_speeds_.send(sound_speeds_under_way_.front().second);
    sound_speeds_under_way_.pop_front();
  }
}

void NavigationNode::measure_position(std::int64_t n) {
  const msg::Position position = sensors_.position(*truth_, n, *world_);
  positions_.send(position);
  const auto& fix = position.position_enu_m;
  filter_.predict(SimTime{position.stamp_ns}, filter_.velocity_enu_mps());
  filter_.correct({fix[0], fix[1], fix[2]});
}

void NavigationNode::estimate(const msg::Attitude& attitude) {
  attitudes_.send(attitude);
  if (!filter_.ready()) return;
  msg::Estimate estimate;
  estimate.stamp_ns = attitude.stamp_ns;
  estimate.position_enu_m = plain(filter_.position_enu_m());
  estimate.enu_from_body = frames::wxyz_of(
      frames::enu_from_body(frames::Attitude{attitude.heading_grid_rad, attitude.pitch_rad, attitude.roll_rad}));
  estimate.velocity_enu_mps = plain(filter_.velocity_enu_mps());
  estimates_.send(estimate);
}

}  // namespace ensonify

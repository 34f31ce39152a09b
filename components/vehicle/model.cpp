#include "components/vehicle/model.h"

#include <algorithm>

#include "kernels/frames/attitude.h"

namespace ensonify {

VehicleModel::VehicleModel(const VehicleConfig& config, const motion::State& start, SimTime now)
    : limits_(config.limits),
      fastest_mps_(config.fastest_mps),
      waves_(config.waves),
      state_(start),
      command_{start.heading_rad, start.speed_mps, start.position_enu_m.z()},
      now_(now) {}

void VehicleModel::advance(SimTime now) {
  state_ = motion::advance(state_, command_, seconds(now - now_), limits_);
  now_ = now;
}

void VehicleModel::command(const msg::Guidance& guidance) {
  command_.heading_rad = guidance.heading_grid_rad;
  command_.speed_mps = std::clamp(guidance.speed_mps, 0.0, fastest_mps_);
}

msg::Pose VehicleModel::pose() const {
  const auto moving = motion::moving_pose(state_, command_, waves_, seconds(now_), limits_);
  const auto plain = [](const frames::Vec3& v) { return std::array{v.x(), v.y(), v.z()}; };
  msg::Pose pose;
  pose.stamp_ns = now_.count();
  pose.position_enu_m = plain(moving.pose.position_enu_m);
  pose.enu_from_body = frames::wxyz_of(moving.pose.enu_from_body);
  pose.velocity_enu_mps = plain(moving.velocity_enu_mps);
  pose.rate_body_radps = plain(moving.angular_rate_body_radps);
  return pose;
}

}  // namespace ensonify

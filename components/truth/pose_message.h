#pragma once

#include <array>

#include "components/runtime/sim_time.h"
#include "kernels/base/frames/pose.h"
#include "messages/motion.h"

namespace ensonify {

/// The true pose as it is published.
inline msg::Pose pose_message(SimTime now, const frames::MovingPose& moving) {
  const auto plain = [](const frames::Vec3& v) { return std::array{v.x(), v.y(), v.z()}; };
  msg::Pose pose;
  pose.stamp_ns = now.count();
  pose.position_enu_m = plain(moving.pose.position_enu_m);
  pose.enu_from_body = frames::wxyz_of(moving.pose.enu_from_body);
  pose.velocity_enu_mps = plain(moving.velocity_enu_mps);
  pose.rate_body_radps = plain(moving.angular_rate_body_radps);
  pose.acceleration_enu_mps2 = plain(moving.acceleration_enu_mps2);
  pose.angular_acceleration_body_radps2 = plain(moving.angular_acceleration_body_radps2);
  return pose;
}

}  // namespace ensonify

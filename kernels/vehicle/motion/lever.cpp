#include "kernels/vehicle/motion/lever.h"

namespace ensonify::motion {

frames::MovingPose reference_point(const frames::MovingPose& of_point, const frames::Vec3& lever_body_m) {
  const frames::Vec3 &rate = of_point.angular_rate_body_radps, &lever = lever_body_m;
  const frames::Quaternion& enu_from_body = of_point.pose.enu_from_body;
  frames::MovingPose moving = of_point;
  moving.pose.position_enu_m -= enu_from_body * lever;
  moving.velocity_enu_mps -= enu_from_body * rate.cross(lever);
  moving.acceleration_enu_mps2 -=
      enu_from_body * (of_point.angular_acceleration_body_radps2.cross(lever) + rate.cross(rate.cross(lever)));
  return moving;
}

}  // namespace ensonify::motion

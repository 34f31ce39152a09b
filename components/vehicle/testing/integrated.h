#pragma once

#include <functional>

#include "components/vehicle/dynamics.h"

/// For tests: what a vehicle says of its motion, integrated, against where it says it is.
namespace ensonify {

/// Distance of the integrals from the pose at the end.
struct Off {
  frames::Vec3 position_m = frames::Vec3::Zero();  // of the acceleration, twice, from the first place and velocity
  double attitude_rad = 0.0;                       // of the turn rate, from the first attitude
};

/// Through [0, until] in steps that are read at both ends and in the middle: Simpson's rule, the parabola's own double
/// integral, and Runge and Kutta's fourth order for the attitude. `steer` is called at the start of each step, before
/// `at` is called with its times, so that what an order changes at once is seen from either side.
inline Off integrated(SimTime until, SimTime step, const std::function<void(SimTime)>& steer,
                      const std::function<frames::MovingPose(SimTime)>& at) {
  const auto spun = [](const Eigen::Vector4d& q, const frames::Vec3& rate) -> Eigen::Vector4d {
    return 0.5 * (frames::Quaternion(q) * frames::Quaternion(0.0, rate.x(), rate.y(), rate.z())).coeffs();
  };
  const double h = seconds(step);
  steer(SimTime{0});
  frames::MovingPose last = at(SimTime{0});
  frames::Vec3 position = last.pose.position_enu_m, velocity = last.velocity_enu_mps;
  Eigen::Vector4d q = last.pose.enu_from_body.coeffs();
  for (SimTime t{0}; t < until; t += step) {
    steer(t);
    const frames::MovingPose first = at(t), middle = at(t + step / 2);
    last = at(t + step);
    const frames::Vec3 &a = first.acceleration_enu_mps2, &b = middle.acceleration_enu_mps2;
    position += h * velocity + h * h / 6 * (a + 2 * b);
    velocity += h / 6 * (a + 4 * b + last.acceleration_enu_mps2);
    const Eigen::Vector4d k1 = spun(q, first.angular_rate_body_radps),
                          k2 = spun(q + 0.5 * h * k1, middle.angular_rate_body_radps),
                          k3 = spun(q + 0.5 * h * k2, middle.angular_rate_body_radps),
                          k4 = spun(q + h * k3, last.angular_rate_body_radps);
    q = (q + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)).normalized();
  }
  return {position - last.pose.position_enu_m, frames::Quaternion(q).angularDistance(last.pose.enu_from_body)};
}

/// So of dynamics, from t = 0.
inline Off integrated(Dynamics& vehicle, SimTime until, SimTime step, const std::function<void(SimTime)>& steer) {
  return integrated(until, step, steer, [&](SimTime t) {
    vehicle.advance(t);
    return vehicle.moving();
  });
}

}  // namespace ensonify

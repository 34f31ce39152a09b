#pragma once

#include "components/runtime/sim_time.h"
#include "kernels/base/frames/attitude.h"

namespace ensonify {

/// Position between and through fixes: measured velocity is summed up (trapezoids), each fix pulls the sum towards
/// itself by a fixed gain. This is the steady state of a Kalman filter with white errors in velocity and fix, without
/// its covariance. In steady state a fix's white noise of sigma s leaves s sqrt(gain / (2 - gain)).
class DeadReckoning {
 public:
  explicit DeadReckoning(double gain) : gain_(gain) {}

  /// Times must not fall.
  void predict(SimTime t, const frames::Vec3& velocity_enu_mps);
  /// A fix at the time of the last prediction. The first n fixes are averaged until the gain is below 1 / n.
  void correct(const frames::Vec3& fix_enu_m);

  /// False before the first fix.
  bool ready() const { return fixes_ > 0; }
  const frames::Vec3& position_enu_m() const { return position_enu_m_; }
  const frames::Vec3& velocity_enu_mps() const { return velocity_enu_mps_; }

 private:
  double gain_;
  SimTime t_{0};
  bool moving_ = false;  // a velocity has been given
  int fixes_ = 0;
  frames::Vec3 position_enu_m_ = frames::Vec3::Zero();
  frames::Vec3 velocity_enu_mps_ = frames::Vec3::Zero();
};

}  // namespace ensonify

#include "components/navigation/dead_reckoning.h"

#include <algorithm>

namespace ensonify {

void DeadReckoning::predict(SimTime t, const frames::Vec3& velocity) {
  if (moving_) position_enu_m_ += 0.5 * seconds(t - t_) * (velocity_enu_mps_ + velocity);
  velocity_enu_mps_ = velocity;
  t_ = t;
  moving_ = true;
}

void DeadReckoning::correct(const frames::Vec3& fix) {
  fixes_ = std::min(fixes_ + 1, 1'000'000);
  position_enu_m_ += std::max(gain_, 1.0 / fixes_) * (fix - position_enu_m_);
}

}  // namespace ensonify

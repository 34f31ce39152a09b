#pragma once

#include <cstdint>
#include <deque>
#include <utility>

#include "kernels/base/frames/attitude.h"

namespace ensonify::nav_out {

/// The acceleration by velocities: their change over the last tenth of a second, so that it is half of that old.
class Accelerating {
 public:
  void take(std::int64_t stamp_ns, const frames::Vec3& velocity_enu_mps) {
    velocities_.emplace_back(stamp_ns, velocity_enu_mps);
    while (velocities_.size() > 2 && velocities_[1].first <= stamp_ns - kOver_ns) velocities_.pop_front();
  }

  /// Zero before there are two velocities.
  frames::Vec3 acceleration_enu_mps2() const {
    if (velocities_.size() < 2) return frames::Vec3::Zero();
    const auto& [from_ns, from_mps] = velocities_.front();
    const auto& [to_ns, to_mps] = velocities_.back();
    if (to_ns <= from_ns) return frames::Vec3::Zero();
    return (to_mps - from_mps) / (1e-9 * static_cast<double>(to_ns - from_ns));
  }

 private:
  static constexpr std::int64_t kOver_ns = 100'000'000;
  std::deque<std::pair<std::int64_t, frames::Vec3>> velocities_;
};

}  // namespace ensonify::nav_out

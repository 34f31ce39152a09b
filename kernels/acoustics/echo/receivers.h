#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/base/frames/pose.h"

namespace ensonify::echo {

/// Track of the receiver while echoes come back: poses at start_s + i * period_s after transmission, straight lines
/// between, the nearest one outside.
struct ReceiveTrack {
  double start_s = 0.0;
  double period_s = 1.0;
  std::span<const frames::HeadPose> poses;  // one is enough for a receiver at rest
};

/// The receiver's track made ready for many look-ups.
class Receivers {
 public:
  /// Throws std::invalid_argument without a pose.
  void set(const ReceiveTrack& track);

  struct At {
    frames::Vec3 position_enu_m;
    Eigen::Matrix3f head_from_enu;
  };
  /// Attitude between two poses: the mean of the matrices, right to the square of the turn between them.
  At at(double time_s) const;

  /// How far the receiver gets from where it is at the first pose, m.
  double farthest_m() const;

  // For many times: first in which step between two poses each lies and how much of that has passed (0..1), then what
  // is wanted then, with a fourth row of zeros so that it is vector code.
  void steps(std::span<const double> time_s, std::span<std::int32_t> step, std::span<double> passed) const;
  Eigen::Vector4d position_enu_m(std::int32_t step, double passed) const {
    const Step& in = steps_[static_cast<std::size_t>(step)];
    return in.position_enu_m + passed * in.position_change_m;
  }
  Eigen::Matrix<float, 4, 3> head_from_enu(std::int32_t step, double passed) const {
    const Step& in = steps_[static_cast<std::size_t>(step)];
    return in.head_from_enu + static_cast<float>(passed) * in.matrix_change;
  }

 private:
  /// Between two poses: at the first, and what is more at the second.
  struct Step {
    Eigen::Vector4d position_enu_m, position_change_m;
    Eigen::Matrix<float, 4, 3> head_from_enu, matrix_change;
  };

  double start_s_ = 0.0, rate_hz_ = 1.0, last_ = 0.0;
  std::vector<Step> steps_;  // at least one
};

}  // namespace ensonify::echo

#include "examples/gyro/model.h"

#include "kernels/base/frames/attitude.h"

namespace ensonify {

msg::Attitude GyroModel::measure(const msg::Pose& truth, std::int64_t n) const {
  const double true_rad = frames::attitude_of(frames::quaternion_of(truth.enu_from_body)).heading_rad;
  const double error_rad = config_.bias_rad + config_.sigma_rad * noise_.normal(static_cast<std::uint64_t>(n));
  msg::Attitude measured;
  measured.stamp_ns = truth.stamp_ns;
  measured.heading_grid_rad = frames::wrap_two_pi(true_rad + error_rad);
  return measured;
}

}  // namespace ensonify

#include "kernels/acoustics/echo/receivers.h"

#include <algorithm>
#include <stdexcept>

namespace ensonify::echo {

void Receivers::set(const ReceiveTrack& track) {
  if (track.poses.empty()) throw std::invalid_argument("a receiver's track needs at least one pose");
  start_s_ = track.start_s;
  rate_hz_ = 1.0 / track.period_s;
  last_ = static_cast<double>(track.poses.size() - 1);
  steps_.clear();
  const auto at_pose = [](const frames::HeadPose& pose) {
    Step step;
    step.position_enu_m << pose.position_enu_m, 0.0;
    step.head_from_enu << pose.enu_from_head.conjugate().toRotationMatrix().cast<float>(), Eigen::RowVector3f::Zero();
    return step;
  };
  for (std::size_t i = 0; i < std::max<std::size_t>(1, track.poses.size() - 1); ++i) {
    Step step = at_pose(track.poses[i]);
    const Step next = at_pose(track.poses[std::min(i + 1, track.poses.size() - 1)]);
    step.position_change_m = next.position_enu_m - step.position_enu_m;
    step.matrix_change = next.head_from_enu - step.head_from_enu;
    steps_.push_back(step);
  }
}

void Receivers::steps(std::span<const double> time_s, std::span<std::int32_t> step, std::span<double> passed) const {
  const double start_s = start_s_, rate_hz = rate_hz_, last = last_;
  const auto last_step = static_cast<std::int32_t>(steps_.size()) - 1;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const double steps = std::clamp((time_s[i] - start_s) * rate_hz, 0.0, last);
    step[i] = std::min(static_cast<std::int32_t>(steps), last_step);
    passed[i] = steps - static_cast<double>(step[i]);
  }
}

double Receivers::farthest_m() const {
  double farthest_m = 0.0;
  for (const Step& step : steps_) {
    const Eigen::Vector4d end = step.position_enu_m + step.position_change_m;
    farthest_m = std::max(farthest_m, (end - steps_.front().position_enu_m).norm());
  }
  return farthest_m;
}

Receivers::At Receivers::at(double time_s) const {
  std::int32_t step;
  double passed;
  steps({&time_s, 1}, {&step, 1}, {&passed, 1});
  return {position_enu_m(step, passed).head<3>(), head_from_enu(step, passed).topRows<3>()};
}

}  // namespace ensonify::echo

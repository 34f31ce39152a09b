#include "components/navigation/output_age.h"

#include <algorithm>

#include "kernels/base/frames/pose.h"

namespace ensonify {

msg::Estimate OutputAge::aged(const msg::Estimate& now) {
  if (position_ == SimTime{0} && motion_ == SimTime{0}) return now;
  past_.push_back(now);
  const std::int64_t oldest_ns = now.stamp_ns - std::max(position_, motion_).count();
  while (past_.size() > 1 && past_[1].stamp_ns <= oldest_ns) past_.pop_front();
  const msg::Estimate place = at(now.stamp_ns - position_.count()), motion = at(now.stamp_ns - motion_.count());
  msg::Estimate reported = now;
  reported.position_enu_m = {place.position_enu_m[0], place.position_enu_m[1], motion.position_enu_m[2]};
  reported.enu_from_body = motion.enu_from_body;
  reported.velocity_enu_mps = motion.velocity_enu_mps;
  return reported;
}

msg::Estimate OutputAge::at(std::int64_t t_ns) const {
  const auto after = std::ranges::lower_bound(past_, t_ns, {}, &msg::Estimate::stamp_ns);
  if (after == past_.begin()) return *after;
  const msg::Estimate &a = *(after - 1), &b = *after;
  const double fraction = static_cast<double>(t_ns - a.stamp_ns) / static_cast<double>(b.stamp_ns - a.stamp_ns);
  const auto pose = [](const msg::Estimate& e) {
    return frames::Pose{frames::Vec3(e.position_enu_m.data()), frames::quaternion_of(e.enu_from_body)};
  };
  const frames::Pose between = frames::interpolate(pose(a), pose(b), fraction);
  msg::Estimate estimate = b;
  estimate.enu_from_body = frames::wxyz_of(between.enu_from_body);
  for (std::size_t k = 0; k < 3; ++k) {
    estimate.position_enu_m[k] = between.position_enu_m[static_cast<Eigen::Index>(k)];
    estimate.velocity_enu_mps[k] = a.velocity_enu_mps[k] + fraction * (b.velocity_enu_mps[k] - a.velocity_enu_mps[k]);
  }
  return estimate;
}

}  // namespace ensonify

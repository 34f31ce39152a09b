#include "kernels/base/frames/pose.h"

#include <algorithm>

namespace ensonify::frames {

HeadPose head_pose(const Pose& body, const Mounting& mounting) {
  return {body.position_enu_m + body.enu_from_body * mounting.position_body_m,
          canonical(body.enu_from_body * mounting.body_from_head)};
}

Vec3 enu_from_body(const Pose& pose, const Vec3& point_body_m) {
  return pose.position_enu_m + pose.enu_from_body * point_body_m;
}

Vec3 enu_from_head(const HeadPose& pose, const Vec3& point_head_m) {
  return pose.position_enu_m + pose.enu_from_head * point_head_m;
}

Vec3 head_from_enu(const HeadPose& pose, const Vec3& point_enu_m) {
  return pose.enu_from_head.conjugate() * (point_enu_m - pose.position_enu_m);
}

Pose interpolate(const Pose& a, const Pose& b, double fraction) {
  return {a.position_enu_m + fraction * (b.position_enu_m - a.position_enu_m),
          canonical(a.enu_from_body.slerp(fraction, b.enu_from_body))};
}

bool PoseHistory::push(std::int64_t t_ns, const Pose& pose) {
  if (!entries_.empty() && t_ns <= entries_.back().t_ns) return false;
  entries_.push_back({t_ns, pose});
  while (entries_.size() > 2 && entries_[1].t_ns <= t_ns - keep_ns_) entries_.pop_front();
  return true;
}

std::optional<Pose> PoseHistory::at(std::int64_t t_ns, Outside outside) const {
  if (entries_.empty()) return std::nullopt;
  if (t_ns < oldest_ns() || t_ns > newest_ns()) {
    if (outside == Outside::kNothing) return std::nullopt;
    return t_ns < oldest_ns() ? entries_.front().pose : entries_.back().pose;
  }
  const auto after = std::lower_bound(entries_.begin(), entries_.end(), t_ns,
                                      [](const Entry& entry, std::int64_t t) { return entry.t_ns < t; });
  if (after->t_ns == t_ns) return after->pose;
  const auto before = std::prev(after);
  const double fraction = static_cast<double>(t_ns - before->t_ns) / static_cast<double>(after->t_ns - before->t_ns);
  return interpolate(before->pose, after->pose, fraction);
}

}  // namespace ensonify::frames

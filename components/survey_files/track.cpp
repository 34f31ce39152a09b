#include "components/survey_files/track.h"

#include <algorithm>

namespace ensonify::survey_files {

void Track::sort() {
  std::ranges::stable_sort(poses_, {}, &Entry::unix_ns);
  const auto again = [](const Entry& a, const Entry& b) { return a.unix_ns == b.unix_ns; };
  poses_.erase(std::unique(poses_.begin(), poses_.end(), again), poses_.end());
}

std::optional<frames::Pose> Track::at(std::int64_t unix_ns) const {
  const auto after = std::ranges::lower_bound(poses_, unix_ns, {}, &Entry::unix_ns);
  if (after == poses_.end()) return std::nullopt;
  if (after->unix_ns == unix_ns) return after->pose;
  if (after == poses_.begin()) return std::nullopt;
  const Entry& before = *(after - 1);
  const std::int64_t gap_ns = after->unix_ns - before.unix_ns;
  if (gap_ns > kLongestGap_ns) return std::nullopt;
  return frames::interpolate(before.pose, after->pose,
                             static_cast<double>(unix_ns - before.unix_ns) / static_cast<double>(gap_ns));
}

std::optional<frames::MovingPose> Track::moving_at(std::int64_t unix_ns) const {
  constexpr std::int64_t kHalf_ns = 100'000'000;
  constexpr double kHalf_s = 0.1;
  const auto before = at(unix_ns - kHalf_ns), now = at(unix_ns), after = at(unix_ns + kHalf_ns);
  if (!before || !now || !after) return std::nullopt;
  const frames::Quaternion turn = before->enu_from_body.conjugate() * after->enu_from_body;
  frames::MovingPose moving{.pose = *now};
  moving.velocity_enu_mps = (after->position_enu_m - before->position_enu_m) / (2.0 * kHalf_s);
  moving.angular_rate_body_radps =
      (turn.w() < 0.0 ? -1.0 : 1.0) * turn.vec() / kHalf_s;  // of a small turn, twice the vector
  return moving;
}

}  // namespace ensonify::survey_files

#include "tools/georeference/track.h"

#include <algorithm>

namespace ensonify::georeference_tool {

void Track::sort() {
  std::ranges::stable_sort(poses_, {}, &Entry::unix_ns);
  const auto again = std::ranges::unique(poses_, {}, &Entry::unix_ns);
  poses_.erase(again.begin(), again.end());
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

}  // namespace ensonify::georeference_tool

#include "components/logger/heave.h"

#include <algorithm>
#include <iterator>

namespace ensonify::logger {

namespace {
constexpr std::int64_t kKept_ns = 30'000'000'000;  // longer than any reception
}

void Heave::push(std::int64_t stamp_ns, double heave_up_m) {
  if (!samples_.empty() && stamp_ns <= samples_.back().stamp_ns) return;
  samples_.push_back({stamp_ns, -heave_up_m});
  while (samples_.front().stamp_ns < stamp_ns - kKept_ns) samples_.pop_front();
}

double Heave::down_m(std::int64_t stamp_ns) const {
  if (samples_.empty()) return 0.0;
  const auto after = std::lower_bound(samples_.begin(), samples_.end(), stamp_ns,
                                      [](const Sample& sample, std::int64_t t_ns) { return sample.stamp_ns < t_ns; });
  if (after == samples_.end()) return samples_.back().down_m;
  if (after == samples_.begin()) return after->down_m;
  const auto before = std::prev(after);
  const double fraction =
      static_cast<double>(stamp_ns - before->stamp_ns) / static_cast<double>(after->stamp_ns - before->stamp_ns);
  return before->down_m + fraction * (after->down_m - before->down_m);
}

std::optional<std::int64_t> Heave::newest_ns() const {
  return samples_.empty() ? std::nullopt : std::optional(samples_.back().stamp_ns);
}

}  // namespace ensonify::logger

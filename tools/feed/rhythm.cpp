#include "tools/feed/rhythm.h"

#include <algorithm>
#include <cmath>

namespace ensonify::feed_doctor {

double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

std::optional<Rhythm> rhythm_of(const std::vector<double>& times_s, double wrap_s) {
  std::vector<double> steps_s, off_ms;
  for (std::size_t i = 1; i < times_s.size(); ++i) {
    const double step_s = times_s[i] - times_s[i - 1];
    steps_s.push_back(wrap_s > 0.0 ? std::remainder(step_s, wrap_s) : step_s);
  }
  if (steps_s.size() < 2) return std::nullopt;
  const double median_s = quantile(steps_s, 0.5);
  for (const double step_s : steps_s) off_ms.push_back(1e3 * std::abs(step_s - median_s));
  return Rhythm{median_s > 0.0 ? std::optional(1.0 / median_s) : std::nullopt, quantile(off_ms, 0.95)};
}

}  // namespace ensonify::feed_doctor

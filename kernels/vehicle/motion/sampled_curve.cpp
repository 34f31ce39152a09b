#include "kernels/vehicle/motion/sampled_curve.h"

#include <algorithm>
#include <cmath>

#include "kernels/vehicle/motion/excursion.h"

namespace ensonify::motion {

bool SampledCurve::push(double t_s, double value) {
  if (!std::isfinite(t_s) || !std::isfinite(value) || (!samples_.empty() && t_s <= newest_s())) return false;
  samples_.push_back({t_s, value});
  return true;
}

void SampledCurve::forget_before(double t_s) {
  while (samples_.size() > 3 && samples_[2].t_s <= t_s) samples_.pop_front();  // one before the piece gives its slope
}

/// Of the parabola through a sample and its neighbours; at the ends that of the straight line.
double SampledCurve::slope(std::size_t i) const {
  const auto chord = [&](std::size_t from) {
    return (samples_[from + 1].value - samples_[from].value) / (samples_[from + 1].t_s - samples_[from].t_s);
  };
  if (samples_.size() == 1) return 0.0;
  if (i == 0) return chord(0);
  if (i + 1 == samples_.size()) return chord(i - 1);
  const double before_s = samples_[i].t_s - samples_[i - 1].t_s, behind_s = samples_[i + 1].t_s - samples_[i].t_s;
  return (behind_s * chord(i - 1) + before_s * chord(i)) / (before_s + behind_s);
}

Moving SampledCurve::at(double t_s) const {
  const auto next = std::upper_bound(samples_.begin(), samples_.end(), t_s,
                                     [](double t, const Sample& sample) { return t < sample.t_s; });
  if (next == samples_.begin() || next == samples_.end()) {
    const std::size_t end = next == samples_.begin() ? 0 : samples_.size() - 1;
    return {samples_[end].value + slope(end) * (t_s - samples_[end].t_s), slope(end), 0.0};
  }
  const auto i = static_cast<std::size_t>(next - samples_.begin()) - 1;
  const Sample &a = samples_[i], &b = samples_[i + 1];
  return cubic_between({a.value, slope(i)}, {b.value, slope(i + 1)}, b.t_s - a.t_s, t_s - a.t_s);
}

}  // namespace ensonify::motion

#include "kernels/vehicle/motion/gapped_curve.h"

#include <algorithm>
#include <cmath>

namespace ensonify::motion {

bool GappedCurve::push(double t_s, double value) {
  if (!std::isfinite(t_s) || !std::isfinite(value) || (!empty() && t_s <= newest_s())) return false;
  if (empty() || interrupted_ || t_s - newest_s() > limits_.gap_s) stretches_.emplace_back();
  interrupted_ = false;
  return stretches_.back().push(t_s, value);
}

void GappedCurve::forget_before(double t_s) {
  while (stretches_.size() > 1 && stretches_[1].oldest_s() <= t_s) stretches_.pop_front();
  if (!empty()) stretches_.front().forget_before(t_s);
}

Moving GappedCurve::at(double t_s) const {
  const auto next = std::upper_bound(stretches_.begin(), stretches_.end(), t_s,
                                     [](double t, const SampledCurve& stretch) { return t < stretch.oldest_s(); });
  if (next == stretches_.begin()) return {next->at(next->oldest_s()).value};
  const SampledCurve& stretch = *std::prev(next);
  const double until_s = stretch.newest_s() + limits_.goes_on_s;
  return t_s <= until_s ? stretch.at(t_s) : Moving{stretch.at(until_s).value};
}

}  // namespace ensonify::motion

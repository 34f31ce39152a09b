#pragma once

#include <cstddef>
#include <deque>

#include "kernels/vehicle/motion/sampled_curve.h"

namespace ensonify::motion {

/// A value whose samples have gaps: on each stretch without a gap a SampledCurve. Behind a stretch it goes on as fast
/// as at its end for `goes_on_s`, and then stays as it is, until the next stretch begins; there it jumps. So nothing is
/// ever drawn across a gap.
class GappedCurve {
 public:
  struct Limits {
    double gap_s = 0.0;      // samples farther apart belong to different stretches
    double goes_on_s = 0.0;  // 0: stays from the last sample on
  };
  explicit GappedCurve(const Limits& limits) : limits_(limits) {}

  /// False, and nothing happens, unless t_s is later than the newest sample's time and both are finite.
  bool push(double t_s, double value);
  /// The next sample begins a stretch, however soon it comes.
  void interrupt() { interrupted_ = true; }
  /// Forgets what no time from t_s on needs.
  void forget_before(double t_s);

  bool empty() const { return stretches_.empty(); }
  double oldest_s() const { return stretches_.front().oldest_s(); }  // not when empty
  double newest_s() const { return stretches_.back().newest_s(); }   // not when empty
  double newest() const { return stretches_.back().newest(); }       // not when empty

  /// Value, rate and acceleration; before the first sample that one's value, at rest. Not when empty.
  Moving at(double t_s) const;

 private:
  Limits limits_;
  bool interrupted_ = false;
  std::deque<SampledCurve> stretches_;  // none is empty
};

}  // namespace ensonify::motion

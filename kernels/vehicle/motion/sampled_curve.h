#pragma once

#include <cstddef>
#include <deque>

#include "kernels/vehicle/motion/excursion.h"

namespace ensonify::motion {

/// A value that is known at some times, in between a curve: cubic pieces through the samples, each sample's slope that
/// of the parabola through it and its neighbours [deBoor2001]. Value and rate are continuous; the acceleration is that
/// of the piece, and jumps at samples. Parabolas are followed exactly. A sample's slope settles when the next one has
/// come: whoever looks two samples behind the newest sees a curve that does not change any more.
class SampledCurve {
 public:
  /// False, and nothing happens, unless t_s is later than the newest sample's time and both are finite.
  bool push(double t_s, double value);
  /// Forgets samples that no time from t_s on needs.
  void forget_before(double t_s);

  std::size_t size() const { return samples_.size(); }
  double oldest_s() const { return samples_.front().t_s; }  // not when empty
  double newest_s() const { return samples_.back().t_s; }   // not when empty
  double newest() const { return samples_.back().value; }   // not when empty

  /// Value, rate and acceleration. Outside the samples it goes on as fast as at their end; not when empty.
  Moving at(double t_s) const;

 private:
  struct Sample {
    double t_s, value;
  };
  double slope(std::size_t i) const;

  std::deque<Sample> samples_;
};

}  // namespace ensonify::motion

#pragma once

#include <cmath>
#include <cstdint>

#include "kernels/base/random/stream.h"

namespace ensonify::random {

/// A slowly wandering error: first-order Gauss-Markov, dx/dt = -x / T + white noise, of standard deviation sigma and
/// autocorrelation exp(-|lag| / T) [Brown2012]. Exact for any step. Step n draws number (n, lane) of the stream, so
/// that processes in different lanes are independent.
class GaussMarkov {
 public:
  GaussMarkov() = default;
  /// sigma >= 0, correlation time > 0. Starts in its stationary distribution.
  GaussMarkov(double sigma, double time_s, const Stream& stream, std::uint64_t lane)
      : sigma_(sigma), time_s_(time_s), value_(sigma * stream.normal(0, lane)) {}

  double value() const { return value_; }

  /// The value dt later (>= 0); `n` counts from 1.
  double advance(double dt_s, const Stream& stream, std::uint64_t n, std::uint64_t lane) {
    const double kept = std::exp(-dt_s / time_s_);
    value_ = kept * value_ + sigma_ * std::sqrt(-std::expm1(-2.0 * dt_s / time_s_)) * stream.normal(n, lane);
    return value_;
  }

 private:
  double sigma_ = 0.0;
  double time_s_ = 1.0;
  double value_ = 0.0;
};

}  // namespace ensonify::random

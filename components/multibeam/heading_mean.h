#pragma once

#include <cmath>
#include <numbers>

namespace ensonify {

/// The heading about which a vehicle yaws: a running mean with a time constant, that of the first measurement to begin
/// with. A steady turn lags it by rate times time constant.
class HeadingMean {
 public:
  explicit HeadingMean(double time_constant_s) : time_constant_s_(time_constant_s) {}

  void update(double time_s, double heading_rad) {
    if (!begun_) mean_rad_ = heading_rad;
    const double share = begun_ ? 1.0 - std::exp(-(time_s - time_s_) / time_constant_s_) : 0.0;
    mean_rad_ += share * std::remainder(heading_rad - mean_rad_, 2.0 * std::numbers::pi);
    time_s_ = time_s;
    begun_ = true;
  }

  double mean_rad() const { return mean_rad_; }

 private:
  double time_constant_s_;
  double time_s_ = 0.0, mean_rad_ = 0.0;
  bool begun_ = false;
};

}  // namespace ensonify

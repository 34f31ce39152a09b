#include "kernels/vehicle/vertical/settling.h"

#include <cmath>

namespace ensonify::vertical {
namespace {

constexpr double kW = 1.0;  // 1/s

}  // namespace

void Settling::advance(double target_m, double dt_s) {
  if (dt_s <= 0.0) return;
  // u = u0 + k t is followed 2 k / w behind; what is off that dies away as (a + b t) exp(-w t).
  const double k = (target_m - target_m_) / dt_s;
  const double a = lower_m_ - target_m_ + 2.0 * k / kW;
  const double b = rate_mps_ - k + kW * a;
  const double gone = std::exp(-kW * dt_s);
  lower_m_ = target_m - 2.0 * k / kW + (a + b * dt_s) * gone;
  rate_mps_ = k + (b - kW * (a + b * dt_s)) * gone;
  target_m_ = target_m;
}

double Settling::acceleration_mps2() const { return kW * kW * (target_m_ - lower_m_) - 2.0 * kW * rate_mps_; }

}  // namespace ensonify::vertical

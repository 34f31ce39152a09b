#include "kernels/instruments/sensors/level.h"

#include <cmath>

namespace ensonify::sensors {

constexpr double kGravity_mps2 = 9.80665;

double LevelError::advance(double across_mps2, double dt_s) {
  const double towards_rad = -(1.0 - settings_.aided_share) * std::atan2(across_mps2, kGravity_mps2);
  lean_rad_ = towards_rad + (lean_rad_ - towards_rad) * std::exp(-dt_s / settings_.time_s);
  return lean_rad_;
}

double LevelError::vertical_error_mps2(double across_mps2) const {
  return kGravity_mps2 * (std::cos(lean_rad_) - 1.0) - across_mps2 * std::sin(lean_rad_);
}

}  // namespace ensonify::sensors

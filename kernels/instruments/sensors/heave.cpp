#include "kernels/instruments/sensors/heave.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace ensonify::sensors {

constexpr double kPi = std::numbers::pi;

double HeaveFilter::measure(double height_m, double acceleration_error_mps2, double dt_s) {
  if (!started_) {
    started_ = true;
    height_m_ = height_m;
    error_mps2_ = acceleration_error_mps2;
    return heave_m_;
  }
  // heave = height + y with y'' = error - 2 z w heave' - w^2 heave; rate_ is y', so heave' = height' + y'. Trapezoids,
  // with the height a straight line between samples.
  const double w = 2.0 * kPi / settings_.cutoff_s, d = 2.0 * settings_.damping * w;
  const double rise_m = height_m - height_m_;
  const double drive = 0.5 * (error_mps2_ + acceleration_error_mps2) - d * rise_m / dt_s;
  // y1' = y' + dt (drive - d (y' + y1') / 2 - w^2 (heave + heave1) / 2), heave1 = heave + rise + dt (y' + y1') / 2
  const double half = 0.5 * dt_s;
  const double known =
      rate_ + dt_s * drive - half * d * rate_ - dt_s * w * w * (heave_m_ + 0.5 * rise_m + 0.5 * half * rate_);
  const double next_rate = known / (1.0 + half * d + half * half * w * w);
  heave_m_ += rise_m + half * (rate_ + next_rate);
  rate_ = next_rate;
  height_m_ = height_m;
  error_mps2_ = acceleration_error_mps2;
  return heave_m_;
}

double delayed_heave_m(std::span<const double> heights_m, std::span<const double> window) {
  if (heights_m.size() != window.size() || window.size() % 2 == 0) {
    throw std::invalid_argument("delayed heave: " + std::to_string(heights_m.size()) + " heights and " +
                                std::to_string(window.size()) + " weights; equal odd numbers are allowed");
  }
  const double middle = heights_m[heights_m.size() / 2];
  double slow = 0.0;
  for (std::size_t i = 0; i < window.size(); ++i) slow += window[i] * (heights_m[i] - middle);
  return -slow;
}

std::vector<double> delayed_heave_window(double cutoff_s, double half_width_s, double step_s) {
  const auto half = static_cast<int>(std::round(half_width_s / step_s));
  std::vector<double> window;
  double sum = 0.0;
  for (int i = -half; i <= half; ++i) {
    const double x = 2.0 * kPi * i * step_s / cutoff_s;
    const double sinc = i == 0 ? 1.0 : std::sin(x) / x;
    window.push_back(sinc * (0.5 + 0.5 * std::cos(kPi * i / (half + 1))));
    sum += window.back();
  }
  for (double& weight : window) weight /= sum;
  return window;
}

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

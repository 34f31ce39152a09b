#include "kernels/acoustics/array/line.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ensonify::array {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kHalfPower = 0.442946470689;  // sinc^2 is one half here

}  // namespace

double sinc(double x) {
  const double a = kPi * x;
  return std::abs(a) < 1e-4 ? 1.0 - a * a / 6.0 : std::sin(a) / a;
}

double line_amplitude(double length_in_waves, double sin_angle, double sin_steer) {
  return sinc(length_in_waves * (sin_angle - sin_steer));
}

double line_power(double length_in_waves, double sin_angle, double sin_steer) {
  const double amplitude = line_amplitude(length_in_waves, sin_angle, sin_steer);
  return amplitude * amplitude;
}

double equivalent_width(double length_in_waves) { return 1.0 / length_in_waves; }

double half_power_half_width(double length_in_waves) { return kHalfPower / length_in_waves; }

double half_power_width_rad(double length_in_waves, double steer_rad) {
  const double half = half_power_half_width(length_in_waves);
  const double upper = std::min(1.0, std::sin(steer_rad) + half);
  const double lower = std::max(-1.0, std::sin(steer_rad) - half);
  return std::asin(upper) - std::asin(lower);
}

double length_in_waves_for(double width_rad) { return kHalfPower / std::sin(0.5 * width_rad); }

double directivity_index_db(double length_in_waves, double width_in_waves) {
  return 10.0 * std::log10(4.0 * kPi * length_in_waves * width_in_waves);
}

}  // namespace ensonify::array

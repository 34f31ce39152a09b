#include "kernels/vehicle/guidance/drift.h"

#include <algorithm>
#include <cmath>

namespace ensonify::guidance {
namespace {

constexpr double kSteepest = 0.9;      // sine of the largest angle upstream
constexpr double kSlowest_mps = 0.05;  // slower than this no heading makes a course good

Vec2 forward(double heading_rad) { return {std::sin(heading_rad), std::cos(heading_rad)}; }
Vec2 starboard(double heading_rad) { return {std::cos(heading_rad), -std::sin(heading_rad)}; }

double sine_upstream(double course_rad, double speed_mps, const Vec2& drift_enu_mps) {
  if (speed_mps < kSlowest_mps) return 0.0;
  return std::clamp(drift_enu_mps.dot(starboard(course_rad)) / speed_mps, -kSteepest, kSteepest);
}

}  // namespace

Vec2 learn_drift(const Vec2& drift_enu_mps, const Vec2& velocity_enu_mps, double heading_rad, double dt_s,
                 double settle_s) {
  const Vec2 across = starboard(heading_rad);
  const double missing_mps = across.dot(velocity_enu_mps - drift_enu_mps);
  return drift_enu_mps + (1.0 - std::exp(-dt_s / settle_s)) * missing_mps * across;
}

Vec2 learn_current(const Vec2& current_enu_mps, const Vec2& velocity_enu_mps, double heading_rad, double speed_mps,
                   double dt_s, double settle_s) {
  const Vec2 left_mps = velocity_enu_mps - speed_mps * forward(heading_rad);
  return current_enu_mps + (1.0 - std::exp(-dt_s / settle_s)) * (left_mps - current_enu_mps);
}

double heading_for_course_rad(double course_rad, double speed_mps, const Vec2& drift_enu_mps) {
  return frames::wrap_two_pi(course_rad - std::asin(sine_upstream(course_rad, speed_mps, drift_enu_mps)));
}

double speed_made_good_mps(double course_rad, double speed_mps, const Vec2& drift_enu_mps) {
  const double sine = sine_upstream(course_rad, speed_mps, drift_enu_mps);
  return speed_mps * std::sqrt(1.0 - sine * sine) + drift_enu_mps.dot(forward(course_rad));
}

}  // namespace ensonify::guidance

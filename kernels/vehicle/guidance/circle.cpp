#include "kernels/vehicle/guidance/circle.h"

#include <cmath>
#include <numbers>

namespace ensonify::guidance {
namespace {

/// Bearing of a place from the centre, clockwise from north.
double bearing_rad(const Circle& circle, const Vec2& position_enu_m) {
  const Vec2 off = position_enu_m - circle.centre_enu_m;
  return std::atan2(off.x(), off.y());
}

}  // namespace

double outside_m(const Circle& circle, const Vec2& position_enu_m) {
  return (position_enu_m - circle.centre_enu_m).norm() - circle.radius_m;
}

double circle_course_rad(const Circle& circle, const Vec2& position_enu_m, double gain) {
  if (position_enu_m == circle.centre_enu_m) return 0.0;
  const double side = circle.clockwise ? 1.0 : -1.0;
  const double inwards_rad = std::atan(gain * outside_m(circle, position_enu_m) / circle.radius_m);
  return frames::wrap_two_pi(bearing_rad(circle, position_enu_m) + side * (0.5 * std::numbers::pi + inwards_rad));
}

double swept_rad(const Circle& circle, const Vec2& from_enu_m, const Vec2& to_enu_m) {
  if (from_enu_m == circle.centre_enu_m || to_enu_m == circle.centre_enu_m) return 0.0;
  const double turned = frames::wrap_pi(bearing_rad(circle, to_enu_m) - bearing_rad(circle, from_enu_m));
  return circle.clockwise ? turned : -turned;
}

}  // namespace ensonify::guidance

#pragma once

#include "kernels/base/frames/attitude.h"

namespace ensonify::guidance {

using frames::Vec2;

struct Circle {
  Vec2 centre_enu_m = Vec2::Zero();
  double radius_m = 10.0;  // > 0
  bool clockwise = true;   // seen from above: the centre lies to starboard
};

/// Distance outside the circle, negative inside.
double outside_m(const Circle& circle, const Vec2& position_enu_m);

/// Course that leads onto the circle and round it: the tangent, turned inwards by atan(gain d / radius) at the distance
/// d outside it ([Beard2012], ch. 10). Far away it points at the centre. gain > 0. At the centre itself: north.
double circle_course_rad(const Circle& circle, const Vec2& position_enu_m, double gain);

/// Angle about the centre that a move covers in the circle's sense, (-pi, pi]; summed over a track it gives the turns
/// made. 0 at the centre.
double swept_rad(const Circle& circle, const Vec2& from_enu_m, const Vec2& to_enu_m);

}  // namespace ensonify::guidance

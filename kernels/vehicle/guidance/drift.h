#pragma once

#include "kernels/base/frames/attitude.h"

namespace ensonify::guidance {

using frames::Vec2;

/// Learns how the water carries a vehicle, from its velocity over ground and its heading. Only what is across the
/// heading counts: a vehicle makes no way sideways, and how fast it goes ahead through the water it need not know. On
/// one heading the drift across it is learned with the time constant `settle_s`; headings that differ give the rest.
/// Sideslip in turns appears as drift: leave turns out.
Vec2 learn_drift(const Vec2& drift_enu_mps, const Vec2& velocity_enu_mps, double heading_rad, double dt_s,
                 double settle_s);

/// Learns the same from a vehicle that makes its speed through the water, both across the heading and along it: what is
/// left of the velocity over ground. For straight ways at a steady speed.
Vec2 learn_current(const Vec2& current_enu_mps, const Vec2& velocity_enu_mps, double heading_rad, double speed_mps,
                   double dt_s, double settle_s);

/// The heading that makes good a course at a speed through the water: it points upstream by asin(across / speed). A
/// drift across the course of more than 0.9 times the speed is taken for that much: the vehicle is carried off.
/// speed_mps >= 0; below 0.05 m/s the course itself.
double heading_for_course_rad(double course_rad, double speed_mps, const Vec2& drift_enu_mps);

/// Speed over ground along that course.
double speed_made_good_mps(double course_rad, double speed_mps, const Vec2& drift_enu_mps);

}  // namespace ensonify::guidance

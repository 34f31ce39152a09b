#pragma once

#include "kernels/base/frames/attitude.h"
#include "kernels/instruments/inertial/earth.h"

/// Strapdown inertial navigation: from what gyros and accelerometers fixed to the body sense to where the body is.
namespace ensonify::inertial {

using frames::Quaternion;
using frames::Vec3;

/// Position on the ellipsoid, velocity over ground and attitude; north, east, down at the place.
struct NavigationState {
  double latitude_rad = 0.0;  // geodetic, |latitude| < 89.9 deg: east has no meaning at the poles
  double longitude_rad = 0.0;
  double height_m = 0.0;  // above the ellipsoid
  Vec3 velocity_ned_mps = Vec3::Zero();
  Quaternion ned_from_body = Quaternion::Identity();  // body is forward, starboard, down
};

/// Input of ideal sensors: turn rate against inertial space, and specific force (acceleration less gravitation, so
/// [0, 0, -g] at rest and level), both along the body's axes.
struct Inertial {
  Vec3 rate_radps = Vec3::Zero();
  Vec3 force_mps2 = Vec3::Zero();
};

/// Free: height follows from the vertical accelerometer, and its error grows as exp(t sqrt(2 g / R)), tenfold in 22
/// minutes. Held: height and vertical velocity stay as they are, as if held by a perfect depth sensor.
enum class VerticalChannel { kFree, kHeld };

/// The state dt later [Groves2013, ch. 5.4; Titterton2004, ch. 3], by one step of the classical fourth-order
/// Runge-Kutta rule from the readings at the step's start, middle and end.
NavigationState advance(const NavigationState& state, const Inertial& start, const Inertial& middle,
                        const Inertial& end, double dt_s, const Earth& earth,
                        VerticalChannel vertical = VerticalChannel::kFree);

/// The same with readings that do not change during the step: what one sample of integrating sensors says.
NavigationState advance(const NavigationState& state, const Inertial& mean, double dt_s, const Earth& earth,
                        VerticalChannel vertical = VerticalChannel::kFree);

/// The steady readings that take `from` to the velocity and attitude of `to` in dt: the inverse of advance(), to
/// rounding. The place reached is that of uniform acceleration, whatever place `to` names.
Inertial sensed_between(const NavigationState& from, const NavigationState& to, double dt_s, const Earth& earth);

/// Turn rate of north-east-down against inertial space: of the Earth, and of the vehicle's way over its curve.
Vec3 earth_rate_ned_radps(const NavigationState& state, const Earth& earth);
Vec3 transport_rate_ned_radps(const NavigationState& state, const Earth& earth);

}  // namespace ensonify::inertial

#pragma once

#include "kernels/base/frames/attitude.h"

/// Strapdown inertial navigation: from what gyros and accelerometers fixed to the body sense to where the body is.
namespace ensonify::inertial {

/// The figure, rotation and normal gravity of an ellipsoid of revolution.
struct Earth {
  double equatorial_radius_m = 6378137.0;  // a; WGS 84 throughout [NIMA2000]
  double flattening = 1.0 / 298.257223563;
  double rate_radps = 7.292115e-5;
  double gravitational_constant_m3ps2 = 3.986004418e14;  // GM
  double equatorial_gravity_mps2 = 9.7803253359;
  double gravity_k = 0.00193185265241;  // Somigliana's constant, b gamma_p / (a gamma_e) - 1
};

/// Radius of curvature north-south, M.
double meridian_radius_m(const Earth& earth, double latitude_rad);

/// Radius of curvature east-west, N.
double prime_vertical_radius_m(const Earth& earth, double latitude_rad);

/// Normal gravity, downwards along the ellipsoid's normal, centrifugal part included: Somigliana's formula on the
/// ellipsoid and its expansion to second order in height [NIMA2000, eqs 4-1, 4-3]. Good to 2e-6 m/s^2 within 10 km of
/// the ellipsoid; deflections of the vertical and anomalies (up to 1e-3 m/s^2) are left out.
double gravity_mps2(const Earth& earth, double latitude_rad, double height_m);

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

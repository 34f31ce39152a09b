#pragma once

namespace ensonify::inertial {

/// The figure, rotation and normal gravity of an ellipsoid of revolution.
struct Earth {
  double equatorial_radius_m = 6378137.0;  // a; WGS 84 throughout [NIMA2000]
  double flattening = 1.0 / 298.257223563;
  double rate_radps = 7.292115e-5;
  double gravitational_constant_m3ps2 = 3.986004418e14;  // GM
  double equatorial_gravity_mps2 = 9.7803253359;
  double gravity_k = 0.00193185265241;  // Somigliana's constant, b gamma_p / (a gamma_e) - 1

  /// A sphere that does not turn: where the closed forms of drift.h hold.
  static Earth resting_sphere(double radius_m, double gravity_mps2);
};

/// Radius of curvature north-south, M.
double meridian_radius_m(const Earth& earth, double latitude_rad);

/// Radius of curvature east-west, N.
double prime_vertical_radius_m(const Earth& earth, double latitude_rad);

/// Normal gravity, downwards along the ellipsoid's normal, centrifugal part included: Somigliana's formula on the
/// ellipsoid and its expansion to second order in height [NIMA2000, eqs 4-1, 4-3]. Good to 1e-6 m/s^2 within 10 km of
/// the ellipsoid; deflections of the vertical and anomalies (up to 1e-3 m/s^2) are left out.
double gravity_mps2(const Earth& earth, double latitude_rad, double height_m);

}  // namespace ensonify::inertial

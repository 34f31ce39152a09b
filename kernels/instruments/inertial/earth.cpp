#include "kernels/instruments/inertial/earth.h"

#include <cmath>

namespace ensonify::inertial {
namespace {

double squared(double x) { return x * x; }

double eccentricity_squared(const Earth& earth) { return earth.flattening * (2.0 - earth.flattening); }

}  // namespace

Earth Earth::resting_sphere(double radius_m, double gravity_mps2) {
  return {radius_m, 0.0, 0.0, gravity_mps2 * squared(radius_m), gravity_mps2, 0.0};
}

double meridian_radius_m(const Earth& earth, double latitude_rad) {
  const double e2 = eccentricity_squared(earth);
  return earth.equatorial_radius_m * (1.0 - e2) / std::pow(1.0 - e2 * squared(std::sin(latitude_rad)), 1.5);
}

double prime_vertical_radius_m(const Earth& earth, double latitude_rad) {
  return earth.equatorial_radius_m / std::sqrt(1.0 - eccentricity_squared(earth) * squared(std::sin(latitude_rad)));
}

double gravity_mps2(const Earth& earth, double latitude_rad, double height_m) {
  const double a = earth.equatorial_radius_m, f = earth.flattening;
  const double sin2 = squared(std::sin(latitude_rad));
  const double on_ellipsoid = earth.equatorial_gravity_mps2 * (1.0 + earth.gravity_k * sin2) /
                              std::sqrt(1.0 - eccentricity_squared(earth) * sin2);
  const double m = squared(earth.rate_radps * a) * a * (1.0 - f) / earth.gravitational_constant_m3ps2;
  const double h = height_m / a;
  return on_ellipsoid * (1.0 - 2.0 * (1.0 + f + m - 2.0 * f * sin2) * h + 3.0 * h * h);
}

}  // namespace ensonify::inertial

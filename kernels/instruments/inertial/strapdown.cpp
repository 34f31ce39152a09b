#include "kernels/instruments/inertial/strapdown.h"

#include <cmath>

namespace ensonify::inertial {
namespace {

double squared(double x) { return x * x; }

double eccentricity_squared(const Earth& earth) { return earth.flattening * (2.0 - earth.flattening); }

using Packed = Eigen::Matrix<double, 10, 1>;  // latitude, longitude, height; velocity; quaternion w, x, y, z

Packed packed(const NavigationState& state) {
  const Quaternion& q = state.ned_from_body;
  Packed x;
  x << state.latitude_rad, state.longitude_rad, state.height_m, state.velocity_ned_mps, q.w(), q.x(), q.y(), q.z();
  return x;
}

NavigationState unpacked(const Packed& x) {
  return {x[0], x[1], x[2], x.segment<3>(3), Quaternion(x[6], x[7], x[8], x[9]).normalized()};
}

Quaternion pure(const Vec3& v) { return {0.0, v.x(), v.y(), v.z()}; }

Packed derivative(const Packed& x, const Inertial& sensed, const Earth& earth, VerticalChannel vertical) {
  const NavigationState state = unpacked(x);
  const Vec3& v = state.velocity_ned_mps;
  const Vec3 earth_rate = earth_rate_ned_radps(state, earth), transport = transport_rate_ned_radps(state, earth);
  const double north_m = meridian_radius_m(earth, state.latitude_rad) + state.height_m;
  const double east_m = prime_vertical_radius_m(earth, state.latitude_rad) + state.height_m;

  const Vec3 gravity(0.0, 0.0, gravity_mps2(earth, state.latitude_rad, state.height_m));
  Vec3 acceleration = state.ned_from_body * sensed.force_mps2 + gravity - (2.0 * earth_rate + transport).cross(v);
  const bool held = vertical == VerticalChannel::kHeld;
  if (held) acceleration.z() = 0.0;

  const Eigen::Vector4d turn = 0.5 * ((state.ned_from_body * pure(sensed.rate_radps)).coeffs() -
                                      (pure(earth_rate + transport) * state.ned_from_body).coeffs());  // x, y, z, w
  Packed rate;
  rate << v.x() / north_m, v.y() / (east_m * std::cos(state.latitude_rad)), held ? 0.0 : -v.z(), acceleration, turn[3],
      turn[0], turn[1], turn[2];
  return rate;
}

}  // namespace

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

Vec3 earth_rate_ned_radps(const NavigationState& state, const Earth& earth) {
  return earth.rate_radps * Vec3(std::cos(state.latitude_rad), 0.0, -std::sin(state.latitude_rad));
}

Vec3 transport_rate_ned_radps(const NavigationState& state, const Earth& earth) {
  const Vec3& v = state.velocity_ned_mps;
  const double north_m = meridian_radius_m(earth, state.latitude_rad) + state.height_m;
  const double east_m = prime_vertical_radius_m(earth, state.latitude_rad) + state.height_m;
  return {v.y() / east_m, -v.x() / north_m, -v.y() * std::tan(state.latitude_rad) / east_m};
}

NavigationState advance(const NavigationState& state, const Inertial& start, const Inertial& middle,
                        const Inertial& end, double dt_s, const Earth& earth, VerticalChannel vertical) {
  const Packed x = packed(state);
  const Packed k1 = derivative(x, start, earth, vertical);
  const Packed k2 = derivative(x + 0.5 * dt_s * k1, middle, earth, vertical);
  const Packed k3 = derivative(x + 0.5 * dt_s * k2, middle, earth, vertical);
  const Packed k4 = derivative(x + dt_s * k3, end, earth, vertical);
  return unpacked(x + dt_s / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4));
}

NavigationState advance(const NavigationState& state, const Inertial& mean, double dt_s, const Earth& earth,
                        VerticalChannel vertical) {
  return advance(state, mean, mean, mean, dt_s, earth, vertical);
}

Inertial sensed_between(const NavigationState& from, const NavigationState& to, double dt_s, const Earth& earth) {
  const Vec3 down(0.0, 0.0, gravity_mps2(earth, from.latitude_rad, from.height_m));
  Inertial sensed{Vec3::Zero(), from.ned_from_body.conjugate() * -down};
  for (int i = 0; i < 4; ++i) {  // each round leaves of the error no more than the angle turned in dt, squared
    const NavigationState reached = advance(from, sensed, dt_s, earth);
    const Eigen::AngleAxisd missing(frames::canonical(reached.ned_from_body.conjugate() * to.ned_from_body));
    sensed.rate_radps += missing.angle() / dt_s * missing.axis();
    const Vec3 lacking = (to.velocity_ned_mps - reached.velocity_ned_mps) / dt_s;
    sensed.force_mps2 += from.ned_from_body.slerp(0.5, to.ned_from_body).conjugate() * lacking;
  }
  return sensed;
}

}  // namespace ensonify::inertial

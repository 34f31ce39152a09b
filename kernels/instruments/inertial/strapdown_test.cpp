#include "kernels/instruments/inertial/strapdown.h"

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/NormalGravity.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

using namespace ensonify::inertial;
using Catch::WithinAbs;
using Eigen::Matrix3d;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
const Earth kWgs84;

Quaternion attitude(double heading_rad, double pitch_rad, double roll_rad) {
  return Eigen::AngleAxisd(heading_rad, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Vec3::UnitY()) *
         Eigen::AngleAxisd(roll_rad, Vec3::UnitX());
}

/// A ship that circles at 5 m/s, once in ten minutes, rolling 10 degrees in 8 s and pitching 3 in 6.
NavigationState circling(double t) {
  const double turn = 2 * std::numbers::pi / 600, heading = turn * t;
  NavigationState state{44 * kDegree, -63 * kDegree, 10.0};
  state.velocity_ned_mps = 5.0 * Vec3(std::cos(heading), std::sin(heading), 0.0);
  state.ned_from_body = attitude(heading, 3 * kDegree * std::sin(2 * std::numbers::pi * t / 6),
                                 10 * kDegree * std::sin(2 * std::numbers::pi * t / 8));
  return state;
}

double level_distance_m(const NavigationState& a, const NavigationState& b) {
  const double north = (a.latitude_rad - b.latitude_rad) * meridian_radius_m(kWgs84, b.latitude_rad);
  const double east =
      (a.longitude_rad - b.longitude_rad) * prime_vertical_radius_m(kWgs84, b.latitude_rad) * std::cos(b.latitude_rad);
  return std::hypot(north, east);
}

double distance_m(const NavigationState& a, const NavigationState& b) {
  return std::hypot(level_distance_m(a, b), a.height_m - b.height_m);
}

/// Inertial navigation in the Earth's own frame: Cartesian place and velocity, a rotation matrix, exponentials for
/// turns, Simpson's rule for force and the midpoint rule for the rest. Nothing is shared with the kernel but the
/// readings; gravity and geodetic places are GeographicLib's.
class EarthCentred {
 public:
  explicit EarthCentred(const NavigationState& start) {
    geocentric_.Forward(start.latitude_rad / kDegree, start.longitude_rad / kDegree, start.height_m, r_[0], r_[1],
                        r_[2]);
    const Matrix3d ecef_from_ned = ned_at(start.latitude_rad, start.longitude_rad);
    v_ = ecef_from_ned * start.velocity_ned_mps;
    c_ = ecef_from_ned * start.ned_from_body.toRotationMatrix();
  }

  void step(const Inertial& sensed, double dt) {
    const Vec3 spin(0, 0, kWgs84.rate_radps);
    const Matrix3d half = turn(-0.5 * dt * spin) * c_ * turn(0.5 * dt * sensed.rate_radps);
    const Matrix3d end = turn(-dt * spin) * c_ * turn(dt * sensed.rate_radps);
    const Vec3 force = (c_ + 4.0 * half + end) / 6.0 * sensed.force_mps2;
    const auto acceleration = [&](const Vec3& r, const Vec3& v) {
      return Vec3(force + gravity(r) - 2.0 * spin.cross(v));
    };
    const Vec3 v_half = v_ + 0.5 * dt * acceleration(r_, v_);
    const Vec3 r_half = r_ + 0.5 * dt * v_;
    v_ += dt * acceleration(r_half, v_half);
    r_ += dt * v_half;
    c_ = end;
  }

  NavigationState state() const {
    double latitude, longitude, height;
    geocentric_.Reverse(r_[0], r_[1], r_[2], latitude, longitude, height);
    return {latitude * kDegree, longitude * kDegree, height};
  }

 private:
  static Matrix3d turn(const Vec3& angle) {
    return Eigen::AngleAxisd(angle.norm(), angle.normalized()).toRotationMatrix();
  }
  static Matrix3d ned_at(double lat, double lon) {
    Matrix3d m;
    m << -std::sin(lat) * std::cos(lon), -std::sin(lon), -std::cos(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon),
        std::cos(lon), -std::cos(lat) * std::sin(lon), std::cos(lat), 0.0, -std::sin(lat);
    return m;
  }
  static Vec3 gravity(const Vec3& r) {  // of the exact level ellipsoid, centrifugal part included
    Vec3 g;
    GeographicLib::NormalGravity::WGS84().U(r[0], r[1], r[2], g[0], g[1], g[2]);
    return g;
  }

  const GeographicLib::Geocentric& geocentric_ = GeographicLib::Geocentric::WGS84();
  Vec3 r_, v_;
  Matrix3d c_;
};

}  // namespace

TEST_CASE("normal gravity is that of the level ellipsoid") {
  for (const double latitude : {0.0, 30.0, 44.0, 60.0, 89.0}) {
    for (const double height : {-10000.0, 0.0, 10000.0}) {
      double north, up;
      const auto& exact = GeographicLib::NormalGravity::WGS84();
      exact.Gravity(latitude, height, north, up);
      CAPTURE(latitude, height);
      CHECK_THAT(gravity_mps2(kWgs84, latitude * kDegree, height), WithinAbs(-up, 2e-6));
    }
  }
  CHECK_THAT(gravity_mps2(kWgs84, 90 * kDegree, 0), WithinAbs(9.8321849379, 1e-9));  // [NIMA2000], table 3.4
}

TEST_CASE("a body at rest on the turning Earth stays where it is") {
  NavigationState state{44 * kDegree, 10 * kDegree, 0.0};
  state.ned_from_body = attitude(1.0, 0.05, -0.1);
  const Vec3 felt_ned(0, 0, -gravity_mps2(kWgs84, state.latitude_rad, 0.0));
  const Inertial sensed{state.ned_from_body.conjugate() * earth_rate_ned_radps(state, kWgs84),
                        state.ned_from_body.conjugate() * felt_ned};
  NavigationState later = state;
  for (int i = 0; i < 6000; ++i) later = advance(later, sensed, 0.1, kWgs84);
  CHECK(distance_m(later, state) < 1e-6);
  CHECK(later.ned_from_body.angularDistance(state.ned_from_body) < 1e-11);
}

TEST_CASE("one step is of fourth order") {
  // Readings that change smoothly; the same 8 s by steps h and h / 2, against h / 8. Fourth order: 16 times less.
  const auto reading = [](double t) {
    return Inertial{{0.3 * std::cos(2 * t), 0.2 * std::sin(3 * t), 0.1}, {std::sin(t), std::cos(2 * t), -9.8}};
  };
  const auto end = [&](int steps) {
    NavigationState state{44 * kDegree, 0.0, 0.0};
    const double h = 8.0 / steps;
    for (int i = 0; i < steps; ++i) {
      const double t = i * h;
      state = advance(state, reading(t), reading(t + h / 2), reading(t + h), h, kWgs84);
    }
    return state;
  };
  const NavigationState best = end(800);
  const double coarse = distance_m(end(100), best), fine = distance_m(end(200), best);
  CHECK(coarse / fine == Approx(16.0).epsilon(0.15));
}

TEST_CASE("readings found between two states lead from one to the other") {
  NavigationState state = circling(0.0);
  for (int i = 1; i <= 1000; ++i) {
    NavigationState to = circling(0.01 * i);
    state = advance(state, sensed_between(state, to, 0.01, kWgs84), 0.01, kWgs84);
    REQUIRE((state.velocity_ned_mps - to.velocity_ned_mps).norm() < 1e-10);
    REQUIRE(state.ned_from_body.angularDistance(to.ned_from_body) < 1e-10);
  }
}

TEST_CASE("drift on the rotating ellipsoid is an independent integration's within 1 %") {
  struct Case {
    double time_s, step_s;
    Vec3 gyro_bias_degph, accelerometer_bias_ug;
  };
  for (const Case& c :
       {Case{60, 0.1, {0.1, -0.2, 0.1}, {100, 50, -80}}, Case{600, 0.1, {0.01, 0.02, -0.02}, {100, -60, 50}},
        Case{3600, 0.2, {0.01, 0.01, 0.02}, {30, 30, 1}}, Case{5067, 0.1, {0.01, 0.01, 0.02}, {30, 30, 0}}}) {
    NavigationState truth = circling(0.0), drifting = truth;
    EarthCentred independent(truth);
    const Vec3 gyro = c.gyro_bias_degph * kDegree / 3600, force = 9.80665e-6 * c.accelerometer_bias_ug;
    const auto steps = static_cast<int>(c.time_s / c.step_s);
    for (int i = 1; i <= steps; ++i) {
      Inertial sensed = sensed_between(truth, circling(i * c.step_s), c.step_s, kWgs84);
      truth = advance(truth, sensed, c.step_s, kWgs84);
      sensed.rate_radps += gyro;
      sensed.force_mps2 += force;
      drifting = advance(drifting, sensed, c.step_s, kWgs84);
      independent.step(sensed, c.step_s);
    }
    const NavigationState found = independent.state();
    const double level_m = level_distance_m(drifting, truth), height_m = std::abs(drifting.height_m - truth.height_m);
    CAPTURE(c.time_s, level_m, level_distance_m(drifting, found), height_m, drifting.height_m - found.height_m);
    CHECK(level_m > 0.5 * c.time_s / 60);
    CHECK(level_distance_m(drifting, found) < 0.01 * level_m);
    CHECK(std::abs(drifting.height_m - found.height_m) < 0.01 * height_m);
  }
}

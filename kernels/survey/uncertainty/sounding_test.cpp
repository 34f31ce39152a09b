#include "kernels/survey/uncertainty/sounding.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/survey/georeference/sounding.h"

using namespace ensonify;
using namespace ensonify::uncertainty;
using Catch::WithinAbs;
using refraction::SoundSpeedProfile;

namespace {

constexpr double kDegree = M_PI / 180.0;

/// A sounding to starboard of a head that is bow to north: so far down, at this angle from the vertical.
Geometry sounding(double depth_m, double angle_rad, double roll_rad = 0.0) {
  Geometry g;
  g.away_enu_m = {depth_m * std::tan(angle_rad), 0.0, -depth_m};
  g.enu_from_head = frames::enu_from_body({.roll_rad = roll_rad});
  return g;
}

double sd_up(const Geometry& g, const Sources& sources) {
  return std::sqrt(covariance_enu_m2(g, {}, {}, sources)(2, 2));
}

/// Where the instrument puts a sounding that it receives at this sine off its array, in water of 1500 m/s.
Vec3 placed(double sin_array, double roll_rad, double one_way_s, double face_mps, double cast_mps) {
  const double angle = std::asin(sin_array * face_mps / 1500.0) - roll_rad;
  const Vec3 level = georeference::place_sounding(
      {{0.0, std::sin(angle), std::cos(angle)}, 2 * one_way_s, 0.0, face_mps}, SoundSpeedProfile::uniform(cast_mps));
  return {level.y(), level.x(), -level.z()};
}

}  // namespace

TEST_CASE("each source moves a sounding as its closed form says") {
  const double depth = 30.0, angle = 60 * kDegree, x = depth * std::tan(angle), small = 0.1 * kDegree;
  const Geometry g = sounding(depth, angle);
  CHECK(sd_up(g, {.heave_m = 0.05}) == Approx(0.05));
  CHECK(sd_up(g, {.heave_m = 0.03, .tide_m = 0.04}) == Approx(0.05));
  CHECK(sd_up(g, {.roll_rad = small}) == Approx(x * small));
  CHECK_THAT(sd_up(g, {.pitch_rad = small}), WithinAbs(0.0, 1e-12));
  CHECK(covariance_enu_m2(g, {}, {}, {.pitch_rad = small})(1, 1) ==
        Approx(std::pow(depth * small, 2)));  // along the track
  CHECK(covariance_enu_m2(g, {}, {}, {.yaw_rad = small})(1, 1) == Approx(std::pow(x * small, 2)));
  CHECK(covariance_enu_m2(g, {}, {}, {.along_rad = small})(1, 1) == Approx(std::pow(2 * depth * small, 2)));  // a cone
  const Matrix3 lever = covariance_enu_m2(g, {}, {}, {.lever_arm_m = {0.01, 0.02, 0.03}});
  CHECK(lever.diagonal().isApprox(Vec3(0.0004, 0.0001, 0.0009)));  // starboard is east
}

TEST_CASE("latencies take a sounding on with the vehicle's way, turning and heave") {
  Geometry g = sounding(30.0, 45 * kDegree);
  g.velocity_enu_mps = {0.0, 4.0, 0.3};
  g.rate_enu_radps = {0.0, 0.1, 0.0};  // about the bow
  CHECK(covariance_enu_m2(g, {}, {}, {.position_latency_s = 0.02})(1, 1) == Approx(0.08 * 0.08));
  // Starboard down: 30 m x 0.1 rad/s down, 0.3 m/s of heave up.
  CHECK(sd_up(g, {.attitude_latency_s = 0.01}) == Approx((30.0 * 0.1 - 0.3) * 0.01));
}

TEST_CASE("a wrong cast or face speed errs as placing itself does") {
  // The derivative by 0.1 m/s; what is of second order is below 1 % of it.
  for (const double roll : {-10 * kDegree, 0.0, 10 * kDegree}) {
    for (const double angle : {0.0, 20 * kDegree, 45 * kDegree, 55 * kDegree, 65 * kDegree}) {
      INFO("roll " << roll / kDegree << ", angle " << angle / kDegree);
      const Geometry g = sounding(30.0, angle, roll);
      const double sine = std::sin(angle + roll), one_way_s = g.away_enu_m.norm() / 1500.0;
      const Vec3 right = placed(sine, roll, one_way_s, 1500.0, 1500.0);
      CHECK((right - g.away_enu_m).norm() < 1e-6);
      const Vec3 cast = placed(sine, roll, one_way_s, 1500.0, 1500.1) - right;
      const Vec3 face = placed(sine, roll, one_way_s, 1500.1, 1500.0) - right;
      const Matrix3 by_cast = covariance_enu_m2(g, {}, {}, {.cast_mps = 0.1});
      const Matrix3 by_face = covariance_enu_m2(g, {}, {}, {.face_mps = 0.1});
      for (const Eigen::Index axis : {0, 2}) {
        CHECK(std::sqrt(by_cast(axis, axis)) == Approx(std::abs(cast[axis])).epsilon(0.01).margin(2e-6));
        CHECK(std::sqrt(by_face(axis, axis)) == Approx(std::abs(face[axis])).epsilon(0.01).margin(2e-6));
      }
    }
  }
}

TEST_CASE("errors of attitude turn lever arm and sounding as one, with their correlations") {
  Geometry g = sounding(30.0, 45 * kDegree);
  g.lever_enu_m = {2.0, 1.0, -1.0};
  Navigation navigation;
  navigation.position_enu_m2.diagonal() << 0.0004, 0.0004, 0.0009;
  navigation.rotation_enu_rad2 << 4e-8, 1e-8, 0, 1e-8, 2e-8, 0, 0, 0, 9e-8;
  const Vec3 p = g.lever_enu_m + g.away_enu_m;
  // Height moves by turn_east x y - turn_north x x.
  const double up = 4e-8 * p.y() * p.y() - 2 * 1e-8 * p.y() * p.x() + 2e-8 * p.x() * p.x();
  CHECK(covariance_enu_m2(g, {}, navigation, {})(2, 2) == Approx(0.0009 + up));
}

TEST_CASE("what detection states is an error of the range along the beam") {
  const double angle = 60 * kDegree;
  const Geometry g = sounding(20.0, angle);
  const Matrix3 c = covariance_enu_m2(g, {0.02, 0.001}, {}, {});
  const double along = std::hypot(0.02, 40.0 * std::tan(angle) * 0.001);
  CHECK(c(2, 2) == Approx(std::pow(along * std::cos(angle), 2)));
  CHECK(c(0, 0) == Approx(std::pow(along * std::sin(angle), 2)));
}

TEST_CASE("what a footprint hides moves a sounding along its beam") {
  const double angle = 60 * kDegree;
  const Matrix3 c = covariance_enu_m2(sounding(20.0, angle), {.relief_sd_m = 0.05}, {}, {});
  CHECK(c(2, 2) == Approx(0.05 * 0.05));
  CHECK(c(0, 0) == Approx(std::pow(0.05 * std::tan(angle), 2)));
  CHECK(c(0, 2) == Approx(-0.05 * 0.05 * std::tan(angle)));  // too deep is too far out
  CHECK_THAT(c(1, 1), WithinAbs(0.0, 1e-12));
}

TEST_CASE("95 % of errors are within TVU and THU") {
  Matrix3 c = Matrix3::Zero();
  c(2, 2) = 0.01;
  CHECK(tvu_m(c) == Approx(0.196).epsilon(1e-3));
  CHECK(thu_m(c) == 0.0);
  c(0, 0) = c(1, 1) = 0.04;
  CHECK(thu_m(c) == Approx(2.4477 * 0.2).epsilon(1e-4));  // sqrt(-2 ln 0.05)
  c(1, 1) = 0.0;
  CHECK(thu_m(c) == Approx(1.95996 * 0.2).epsilon(1e-4));
  // An ellipse of axes 1 and 0.5, turned by 45 degrees: the integral of its density over this circle is 0.95
  // (by the trapezoidal rule over the angle: 1 - mean of exp(-r^2 / 2 s(angle)^2) weighted with s^2, both below).
  c << 0.625, 0.375, 0, 0.375, 0.625, 0, 0, 0, 0;
  const double r = thu_m(c);
  double inside = 0.0;
  constexpr int kSteps = 720;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = 2 * M_PI * i / kSteps;
    const double s2 = 1.0 / (std::pow(std::cos(angle), 2) + std::pow(std::sin(angle) / 0.5, 2));
    inside += s2 * (1.0 - std::exp(-r * r / (2.0 * s2))) / (0.5 * kSteps);
  }
  CHECK_THAT(inside, WithinAbs(0.95, 0.002));  // the moments' approximation is good to 0.0012
}

TEST_CASE("nadir and the horizon are finite") {
  const Sources all{.cast_mps = 1, .face_mps = 1, .roll_rad = 0.01, .along_rad = 0.01};
  CHECK(covariance_enu_m2(sounding(20, 0.0), {0.01, 0.001}, {}, all).allFinite());
  Geometry level = sounding(20, 0.0);
  level.away_enu_m = {50.0, 0.0, 0.0};
  CHECK(covariance_enu_m2(level, {0.01, 0.001}, {}, all).allFinite());
}

#include "kernels/instruments/navigation_filter/error_state.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/instruments/inertial/testing/drift.h"

using namespace ensonify;
using namespace ensonify::navigation_filter;
using Catch::WithinAbs;
using inertial::Earth;
using inertial::Inertial;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
const inertial::SchulerSphere kSphere;
const Earth kResting = inertial::resting_sphere(kSphere.radius_m, kSphere.gravity_mps2);
const StartErrors kNone{0, 0, 0, 0, 0};
const Inertial kLevelAtRest{Vec3::Zero(), {0, 0, -kSphere.gravity_mps2}};

/// Standard deviation of the place east after drifting at rest.
double sigma_east_m(const StartErrors& errors, const FilterModel& model, double time_s) {
  NavigationFilter filter({}, errors, model, kResting);
  for (int i = 0; i < 10 * time_s; ++i) filter.propagate(kLevelAtRest, 0.1);
  return std::sqrt(filter.covariance()(kPosition + 1, kPosition + 1));
}

double sigma(const NavigationFilter& filter, int i) { return std::sqrt(filter.covariance()(i, i)); }

}  // namespace

TEST_CASE("what the filter expects of each error alone is what it leads to, within 0.1 %") {
  for (const double t : {60.0, 600.0, 3000.0}) {
    CAPTURE(t);
    FilterModel model;
    model.imu.accelerometer.turn_on_bias = 1e-3;
    CHECK(sigma_east_m(kNone, model, t) ==
          Approx(inertial::accelerometer_bias_drift_m(kSphere, 1e-3, t)).epsilon(1e-3));
    model = {};
    model.imu.gyro.turn_on_bias = 1e-7;
    CHECK(sigma_east_m(kNone, model, t) == Approx(inertial::gyro_bias_drift_m(kSphere, 1e-7, t)).epsilon(1e-3));
    model = {};
    model.imu.accelerometer.random_walk = 1e-3;
    CHECK(sigma_east_m(kNone, model, t) ==
          Approx(inertial::velocity_random_walk_drift_m(kSphere, 1e-3, t)).epsilon(1e-3));
    model = {};
    model.imu.gyro.random_walk = 1e-6;
    CHECK(sigma_east_m(kNone, model, t) == Approx(inertial::angle_random_walk_drift_m(kSphere, 1e-6, t)).epsilon(1e-3));
    CHECK(sigma_east_m({0, 0, 0, 1e-4, 0}, {}, t) == Approx(inertial::tilt_drift_m(kSphere, 1e-4, t)).epsilon(1e-3));
  }
}

TEST_CASE("gyro crosstalk tilts by the total turn, however uneven the turn") {
  // A turn by psi about the vertical with crosstalk m from z into x and into y: the tilts' integrals over the turning
  // axes are (sin psi, 1 - cos psi) m and (cos psi - 1, sin psi) m, so each level axis has the variance 2 (1 - cos psi)
  // m^2. Steered in jerks, as by an autopilot, at 100 readings a second: half of each tenth of a second at twice the
  // rate, in one part of it or the other.
  constexpr double kCrosstalk = 5e-5, kRate_radps = 0.1;
  FilterModel model;
  model.imu.gyro.misalignment_rad = kCrosstalk;
  for (const bool first_half : {true, false}) {
    NavigationFilter filter({}, kNone, model, kResting);
    double turned_rad = 0.0;
    for (int i = 1; i <= 6000; ++i) {
      const double rate_radps = (i % 10 < 5) == first_half ? 2 * kRate_radps : 0.0;
      turned_rad += 0.01 * rate_radps;
      filter.propagate({{0, 0, rate_radps}, kLevelAtRest.force_mps2}, 0.01);
      if (i % 1500 != 0) continue;
      CAPTURE(first_half, i);
      const double expected_rad = kCrosstalk * std::sqrt(2 * (1 - std::cos(turned_rad)));
      CHECK(sigma(filter, kRotation) == Approx(expected_rad).epsilon(0.01));  // steps of 0.01 rad
      CHECK(sigma(filter, kRotation + 1) == Approx(expected_rad).epsilon(0.01));
    }
  }
}

TEST_CASE("crosstalk of accelerometers pulls with what the vehicle senses, not always alike") {
  // Of the upright axis into the level ones it is a bias of m g. Gravity off, what pulls along one axis and back leaves
  // the velocity as it was: m (v - v).
  constexpr double kCrosstalk = 1e-3;
  FilterModel model;
  model.imu.accelerometer.misalignment_rad = kCrosstalk;
  FilterModel biased;
  biased.imu.accelerometer.turn_on_bias = kCrosstalk * kSphere.gravity_mps2;
  CHECK(sigma_east_m(kNone, model, 60.0) == Approx(sigma_east_m(kNone, biased, 60.0)).epsilon(1e-6));

  const Earth weightless = inertial::resting_sphere(kSphere.radius_m, 1e-12);
  NavigationFilter filter({}, kNone, model, weightless);
  for (const double force_mps2 : {0.5, -0.5}) {
    for (int i = 0; i < 100; ++i) filter.propagate({Vec3::Zero(), {force_mps2, 0, 0}}, 0.1);
    if (force_mps2 > 0.0) CHECK(sigma(filter, kVelocity + 1) == Approx(kCrosstalk * 5.0).epsilon(1e-3));
  }
  const double left = filter.covariance()(kVelocity + 1, kVelocity + 1);
  CHECK(std::abs(left) < std::pow(1e-3 * kCrosstalk * 5.0, 2));
}

TEST_CASE("what rests on the turning Earth does not turn") {
  NavigationState resting{44 * kDegree, -63 * kDegree, 0.0};
  const Earth earth;
  NavigationFilter filter(resting, kNone, {}, earth);
  const double gravity_mps2 = inertial::gravity_mps2(earth, resting.latitude_rad, 0.0);
  filter.propagate({inertial::earth_rate_ned_radps(resting, earth), {0, 0, -gravity_mps2}}, 0.01);
  CHECK(filter.turn_rate_radps().norm() < 1e-9);
}

TEST_CASE("the turn rate is that of now, not the mean of the last reading's interval") {
  // A rate that grows evenly, read over intervals of different lengths: exact.
  const Vec3 at_start(0.02, -0.01, 0.05), growth(0.1, 0.17, -0.03);
  NavigationFilter filter({}, kNone, {}, kResting);
  double t_s = 0.0;
  for (const double dt_s : {0.01, 0.01, 0.05, 0.02}) {
    filter.propagate({at_start + (t_s + 0.5 * dt_s) * growth, kLevelAtRest.force_mps2}, dt_s);
    const bool first = t_s == 0.0;  // of which nobody knows how it grows
    t_s += dt_s;
    CHECK_THAT((filter.turn_rate_radps() - at_start - t_s * growth).norm(), WithinAbs(0, first ? 1e-3 : 1e-12));
  }
}

TEST_CASE("another body point errs as the unit, the lever arm and the turn make it") {
  // 3 m ahead of a unit that points north and turns, level, at 0.2 rad/s: the point goes east at 0.6 m/s. Each error
  // alone.
  const Vec3 lever(3, 0, 0);
  const Inertial turning{{0, 0, 0.2}, kLevelAtRest.force_mps2};
  constexpr double kStep_s = 1e-3;  // in which nothing else has time to grow
  const auto at = [&](const StartErrors& errors, const FilterModel& model) {
    NavigationFilter filter({}, errors, model, kResting);
    filter.propagate(turning, kStep_s);
    const auto of = filter.covariance_at(lever);
    return std::pair<Vec3, Vec3>(of.position_m2.diagonal().cwiseSqrt(), of.velocity_m2ps2.diagonal().cwiseSqrt());
  };
  const auto is = [](const Vec3& found, const Vec3& expected) {
    CAPTURE(found.transpose(), expected.transpose());
    CHECK((found - expected).norm() < 1e-3 * expected.norm() + 1e-12);
  };
  const auto [still, slow] = at({2.0, 3.0, 0.1, 0, 0}, {});
  is(still, {2, 2, 3});
  is(slow, {0.1, 0.1, 0.1});
  const auto [placed, moved] = at({0, 0, 0, 0.01, 0.02}, {});
  is(placed, {0, 3 * 0.02, 3 * 0.01});     // swung by heading and by pitch
  is(moved, {0.6 * 0.02, 0, 0.6 * 0.01});  // the 0.6 m/s east, turned by heading and by roll
  FilterModel model;
  model.imu.gyro.turn_on_bias = 1e-3;
  is(at(kNone, model).second, {0, 3e-3, 3e-3});
  model = {};
  model.imu.gyro.scale_factor = 0.01;
  is(at(kNone, model).second, {0, 0.6 * 0.01, 0});
  model = {};
  model.imu.gyro.misalignment_rad = 0.01;  // of the upright axis into pitch
  is(at(kNone, model).second, {0, 0, 0.6 * 0.01});
  model = {};
  model.imu.gyro.random_walk = 1e-4;  // 3/2 of a reading less 1/2 of the one before
  const double noise_mps = 3 * 1e-4 * std::sqrt(2.5 / kStep_s);
  is(at(kNone, model).second, {0, noise_mps, noise_mps});

  // The errors of both are one where the unit swings about a point that is known: a fix there leaves little doubt of
  // it.
  NavigationFilter filter({}, {10, 10, 0.1, 0.01, 0.05}, {}, kResting);
  filter.correct_position({0, 0, 0, lever, Vec3::Constant(0.01)});
  CHECK(std::sqrt(filter.covariance_at(lever).position_m2(1, 1)) == Approx(0.01).epsilon(1e-3));
  CHECK(sigma(filter, kPosition + 1) == Approx(std::hypot(0.01, 3 * 0.05)).epsilon(1e-3));
}

TEST_CASE("observations point the right way: what is measured exactly is taken over") {
  // The vehicle points north-east and up, rolled, its sensors off its origin. The estimate starts wrong in one
  // respect, and is given the truth by the sensor that sees it.
  const Vec3 lever(3, -1, 2);
  NavigationState truth{44 * kDegree, -63 * kDegree, -20.0};
  truth.velocity_ned_mps = {1.0, 2.0, -0.3};
  truth.ned_from_body = Eigen::AngleAxisd(0.7, Vec3::UnitZ()) * Eigen::AngleAxisd(0.2, Vec3::UnitY()) *
                        Eigen::AngleAxisd(-0.3, Vec3::UnitX());
  const Earth earth;
  const Vec3 lever_ned = truth.ned_from_body * lever;
  const double north_m = meridian_radius_m(earth, truth.latitude_rad) + truth.height_m;
  const double east_m =
      (prime_vertical_radius_m(earth, truth.latitude_rad) + truth.height_m) * std::cos(truth.latitude_rad);

  SECTION("a heading") {
    NavigationState wrong = truth;
    wrong.ned_from_body = Eigen::AngleAxisd(0.01, Vec3::UnitZ()) * truth.ned_from_body;
    NavigationFilter filter(wrong, {0, 0, 0, 0, 0.02}, {});
    const Vec3 forward = truth.ned_from_body * Vec3::UnitX();
    filter.correct_heading(std::atan2(forward.y(), forward.x()), Vec3::UnitX(), 1e-6);
    CHECK(filter.state().ned_from_body.angularDistance(truth.ned_from_body) < 1e-6);
  }
  SECTION("a heading from a place far away") {
    NavigationState wrong = truth;
    wrong.ned_from_body = Eigen::AngleAxisd(0.01, Vec3::UnitZ()) * truth.ned_from_body;
    NavigationFilter filter(wrong, {0, 0, 0, 0, 0.02}, {});
    filter.correct_velocity(truth.ned_from_body.conjugate() * truth.velocity_ned_mps, Vec3::Zero(),
                            Vec3::Constant(1e-3));
    CHECK(filter.state().ned_from_body.angularDistance(truth.ned_from_body) < 1e-4);  // second order: 0.01^2
  }
  SECTION("tilt, by a lever") {
    NavigationState wrong = truth;
    wrong.ned_from_body = Eigen::AngleAxisd(0.002, Vec3::UnitX()) * truth.ned_from_body;
    NavigationFilter filter(wrong, {0, 0, 0, 0.01, 0}, {});
    filter.correct_height(truth.height_m - lever_ned.z(), lever, 1e-7);
    const Vec3 seen = filter.state().ned_from_body * lever;
    CHECK_THAT(seen.z(), WithinAbs(lever_ned.z(), 1e-5));
    CHECK(sigma(filter, kRotation) < 0.01);
  }
  SECTION("a place, velocity and scale") {
    NavigationState wrong = truth;
    wrong.latitude_rad += 4.0 / north_m;
    wrong.longitude_rad -= 3.0 / east_m;
    wrong.height_m += 2.0;
    NavigationFilter filter(wrong, {10, 10, 0, 0, 0}, {});
    NavigationFilter::Fix fix{truth.latitude_rad + lever_ned.x() / north_m,
                              truth.longitude_rad + lever_ned.y() / east_m, truth.height_m - lever_ned.z(), lever,
                              Vec3::Constant(1e-4)};
    CHECK(filter.correct_position(fix).normalised_squared == Approx((16 + 9 + 4) / 100.0).epsilon(1e-3));
    CHECK_THAT((filter.state().latitude_rad - truth.latitude_rad) * north_m, WithinAbs(0, 1e-3));
    CHECK_THAT((filter.state().longitude_rad - truth.longitude_rad) * east_m, WithinAbs(0, 1e-3));
    CHECK_THAT(filter.state().height_m, WithinAbs(truth.height_m, 1e-3));

    FilterModel model;
    model.log_scale = 0.01;
    NavigationFilter scaled(truth, kNone, model);
    scaled.correct_velocity(1.004 * (truth.ned_from_body.conjugate() * truth.velocity_ned_mps), Vec3::Zero(),
                            Vec3::Constant(1e-6));
    CHECK(scaled.log_scale() == Approx(0.004).epsilon(1e-3));
    model = {};
    model.fix_wander_horizontal_m = 5.0;
    NavigationFilter wandering(truth, kNone, model);
    fix.latitude_rad += 2.0 / north_m;
    wandering.correct_position(fix);
    CHECK(wandering.fix_error_ned_m().x() == Approx(2.0).epsilon(1e-3));
    CHECK_THAT((wandering.state().latitude_rad - truth.latitude_rad) * north_m, WithinAbs(0, 1e-3));
  }
}

TEST_CASE("a fix far beyond belief is refused, and changes nothing") {
  NavigationFilter filter({}, {1, 1, 0.1, 0.01, 0.01}, {}, kResting);
  const auto before = filter.covariance();
  NavigationFilter::Fix fix;
  fix.height_m = 100.0;
  CHECK(!filter.correct_position(fix).accepted);
  CHECK(filter.covariance() == before);
  CHECK(filter.state().height_m == 0.0);
  fix.height_m = 1.0;
  CHECK(filter.correct_position(fix).accepted);
}

TEST_CASE("a heading is refused when the bow points up") {
  NavigationState steep;
  steep.ned_from_body = Eigen::AngleAxisd(89 * kDegree, Vec3::UnitY());
  NavigationFilter filter(steep, {}, {});
  CHECK(!filter.correct_heading(0.0, Vec3::UnitX(), 0.01).accepted);
  CHECK(filter.correct_heading(90 * kDegree, Vec3::UnitY(), 0.01).accepted);  // of an axis that is level
}

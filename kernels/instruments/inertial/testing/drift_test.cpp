#include "kernels/instruments/inertial/testing/drift.h"

#include <catch2/catch.hpp>

#include "kernels/instruments/inertial/strapdown.h"

using namespace ensonify::inertial;
using Catch::WithinAbs;

namespace {

const SchulerSphere kSphere;
const Earth kEarth = resting_sphere(kSphere.radius_m, kSphere.gravity_mps2);
constexpr double kUg = 9.80665e-6;                          // m/s^2
constexpr double kDegph = 3.14159265358979 / 180.0 / 3600;  // rad/s

NavigationState at_rest() { return {}; }

/// North and east of the start after navigating for `time_s` with steady readings, beside an error-free system at rest.
struct Drift {
  double north_m, east_m;
};
Drift drift(NavigationState state, const ensonify::frames::Vec3& gyro_error, const ensonify::frames::Vec3& force_error,
            double time_s) {
  constexpr double kStep_s = 0.1;
  const Inertial sensed{gyro_error, force_error + Vec3(0, 0, -kSphere.gravity_mps2)};
  const auto steps = static_cast<int>(time_s / kStep_s);
  for (int i = 0; i < steps; ++i) state = advance(state, sensed, kStep_s, kEarth, VerticalChannel::kHeld);
  state = advance(state, sensed, time_s - steps * kStep_s, kEarth, VerticalChannel::kHeld);
  return {state.latitude_rad * kSphere.radius_m, state.longitude_rad * kSphere.radius_m};
}

}  // namespace

TEST_CASE("closed forms have their published values") {
  CHECK(kSphere.rate_radps() == Approx(1.2400e-3).epsilon(1e-4));
  CHECK_THAT(kSphere.period_s() / 60, WithinAbs(84.45, 0.01));
  CHECK_THAT(accelerometer_bias_drift_m(kSphere, 100 * kUg, 60), WithinAbs(1.76, 0.006));
  CHECK_THAT(accelerometer_bias_drift_m(kSphere, 100 * kUg, 600), WithinAbs(168.5, 0.06));
  CHECK_THAT(gyro_bias_drift_m(kSphere, 0.01 * kDegph, 60), WithinAbs(0.0171, 6e-5));
  CHECK_THAT(gyro_bias_drift_m(kSphere, 0.01 * kDegph, 600), WithinAbs(16.6, 0.06));
  // R e is the mean speed of a gyro bias's drift: 0.60 nautical miles an hour.
  CHECK_THAT(gyro_bias_drift_m(kSphere, 0.01 * kDegph, kSphere.period_s()) / kSphere.period_s() * 3600 / 1852,
             WithinAbs(0.60, 0.005));
  CHECK(velocity_random_walk_drift_m(kSphere, 1e-3, 10) == Approx(1e-3 * std::sqrt(1000.0 / 3)).epsilon(1e-4));
  CHECK(angle_random_walk_drift_m(kSphere, 1e-6, 20) ==
        Approx(kSphere.gravity_mps2 * 1e-6 * std::sqrt(3.2e6 / 20)).epsilon(1e-3));
}

TEST_CASE("unaided strapdown navigation drifts as the closed forms say, within 0.1 %") {
  // Where a closed form passes through zero, as (1 - cos) does after a period, 0.1 % is of its greatest value.
  for (const double t : {60.0, 600.0, kSphere.period_s()}) {
    const double b = 100 * kUg, e = 0.01 * kDegph, tilt = 1e-4;
    const double greatest_m = t > 4000 ? 1e-3 * 2 * b / std::pow(kSphere.rate_radps(), 2) : 0.0;
    const double greatest_tilt_m = t > 4000 ? 1e-3 * 2 * kSphere.radius_m * tilt : 0.0;
    CAPTURE(t);
    CHECK(drift(at_rest(), Vec3::Zero(), {b, 0, 0}, t).north_m ==
          Approx(accelerometer_bias_drift_m(kSphere, b, t)).epsilon(1e-3).margin(greatest_m));
    CHECK(drift(at_rest(), Vec3::Zero(), {0, b, 0}, t).east_m ==
          Approx(accelerometer_bias_drift_m(kSphere, b, t)).epsilon(1e-3).margin(greatest_m));
    // Turning about east (starboard) lifts the bow; the platform assumes gravity to push it astern: south.
    CHECK(drift(at_rest(), {0, e, 0}, Vec3::Zero(), t).north_m ==
          Approx(-gyro_bias_drift_m(kSphere, e, t)).epsilon(1e-3));
    CHECK(drift(at_rest(), {e, 0, 0}, Vec3::Zero(), t).east_m ==
          Approx(gyro_bias_drift_m(kSphere, e, t)).epsilon(1e-3));

    NavigationState tilted;
    tilted.ned_from_body = Eigen::AngleAxisd(tilt, Vec3::UnitX());
    CHECK(drift(tilted, Vec3::Zero(), Vec3::Zero(), t).east_m ==
          Approx(tilt_drift_m(kSphere, tilt, t)).epsilon(1e-3).margin(greatest_tilt_m));

    // A course north along a meridian turns the level by v / R; the heading error turns that rate aside too.
    NavigationState under_way;
    under_way.velocity_ned_mps = {2.0, 0, 0};
    const double heading_error = 1e-3;
    under_way.ned_from_body = Eigen::AngleAxisd(heading_error, Vec3::UnitZ());
    const double turned = heading_drift_m(2.0, heading_error, t);
    under_way.velocity_ned_mps = {2.0 * std::cos(heading_error), 2.0 * std::sin(heading_error), 0};
    const Vec3 transport(0, -2.0 / kSphere.radius_m, 0);
    CHECK(drift(under_way, transport, Vec3::Zero(), t).east_m == Approx(turned).epsilon(1e-3));
  }
}

TEST_CASE("random walks spread the place as the closed forms say, within 0.1 %", "[long]") {
  // Noise in one sample moves the end by a response that depends on the time left; the responses' squares summed up
  // are the variance, without drawing anything. 600 samples: the sum stands for the integral to 1 part in 1e3 and
  // better (rectangles about their middles).
  for (const double t : {60.0, 600.0, kSphere.period_s()}) {
    const double dt = t / 600, v = 1e-3, tilt = 1e-6;
    double velocity = 0.0, angle = 0.0;
    for (int i = 0; i < 600; i += 20) {  // the response is smooth: every 20th stands for its neighbours
      const double left_s = t - (i + 10) * dt;
      NavigationState kicked, tilted;
      kicked.velocity_ned_mps = {v, 0, 0};
      tilted.ned_from_body = Eigen::AngleAxisd(tilt, Vec3::UnitX());
      velocity += 20 * dt * std::pow(drift(kicked, Vec3::Zero(), Vec3::Zero(), left_s).north_m / v, 2);
      angle += 20 * dt * std::pow(drift(tilted, Vec3::Zero(), Vec3::Zero(), left_s).east_m / tilt, 2);
    }
    CAPTURE(t);
    CHECK(std::sqrt(velocity) == Approx(velocity_random_walk_drift_m(kSphere, 1.0, t)).epsilon(1e-3));
    CHECK(std::sqrt(angle) == Approx(angle_random_walk_drift_m(kSphere, 1.0, t)).epsilon(1e-3));
  }
}

#include "components/vehicle/kinematic/kinematic.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "components/vehicle/testing/integrated.h"

using namespace ensonify;
using frames::Vec3;
constexpr double kDegree = std::numbers::pi / 180.0;

namespace {

constexpr double kM2_radps = 1.405189e-4;

/// With the inertia that scenarios give.
VehicleConfig steerable() {
  VehicleConfig config;
  config.limits.turning_radius_m = 20;
  config.limits.turn_acceleration_radps2 = 10.0 * kDegree;
  config.limits.vertical_acceleration_mps2 = 0.2;
  return config;
}

/// M2 of 1.5 m from high water on, where it bends most, as a gauge reads it every six minutes, to millimetres, from an
/// hour before to an hour behind.
vertical::Tide read_every_six_minutes(double first_s) {
  vertical::GaugeReadings readings;
  for (double t = first_s - 3600.0; t < first_s + 7200.0; t += 360.0) {
    readings.time_s_and_height_m.emplace_back(t, 1e-3 * std::round(1500.0 * std::cos(kM2_radps * t)));
  }
  return vertical::Tide(readings);
}

}  // namespace

TEST_CASE("600 s of published motion in dives through sheared current integrate to the pose") {
  VehicleConfig config = steerable();
  config.water.current.profile = {{2.0, {0.1, 0.4}}, {12.0, {0.3, 0.4}}, {22.0, {0.5, -0.1}}};
  config.water.current.streams = {{{0.5, 0.1}, kM2_radps, 0.4}};
  config.water.tide = read_every_six_minutes(0.0);
  KinematicDynamics auv(config, {{0, 0, -2}, 0.5, 1.5}, 0_s);
  const Off off = integrated(auv, 600_s, 10_ms, [&](SimTime t) {
    if (t % 60_s == 0_s) auv.command(0.5, 1.5, t % 120_s == 0_s ? 24.0 : 2.0);
  });
  // East and north. The vertical acceleration has corners that fall between readings.
  CHECK(off.position_m.head<2>().norm() < 1e-3);
}

TEST_CASE("through a sheared current the pose rate does not change the path") {
  VehicleConfig config = steerable();
  config.water.current.profile = {{2.0, {0.1, 0.4}}, {12.0, {0.3, 0.4}}, {22.0, {0.5, -0.1}}};
  KinematicDynamics often(config, {{0, 0, -2}, 0.5, 1.5}, 0_s), once = often;
  for (auto* auv : {&often, &once}) auv->command(0.5, 1.5, 30.0);
  for (SimTime t{0}; t <= 80_s; t += 1_ms) often.advance(t);
  once.advance(80_s);
  CHECK((often.moving().pose.position_enu_m - once.moving().pose.position_enu_m).norm() < 1e-6);
}

TEST_CASE("600 s on a gauge's tide, afloat and submerged, integrate to the pose") {
  for (const double first_s : {0.0, -123.4}) {
    for (const bool floats : {true, false}) {
      VehicleConfig config = steerable();
      config.water.tide = read_every_six_minutes(first_s);
      if (floats) config.water.floats = vertical::Loading{{{0, 0.0}, {9, 0.3}}, 0.0, -1e-6};
      KinematicDynamics vehicle(config, {{0, 0, floats ? 0.0 : -10.0}, 0.5, 2.0}, 0_s);
      const Off off = integrated(vehicle, 600_s, 20_ms, [](SimTime) {});
      CAPTURE(first_s, floats, off.position_m.z());
      CHECK(off.position_m.norm() < 1e-3);
    }
  }
}

TEST_CASE("a steered vehicle's published motion is the derivative of its position") {
  VehicleConfig config = steerable();
  config.water.current.profile = {{2.0, {0.1, 0.4}}, {12.0, {0.3, 0.4}}, {22.0, {0.5, -0.1}}};
  config.water.tide = read_every_six_minutes(-123.4);
  KinematicDynamics auv(config, {{0, 0, -2}, 0.5, 1.5}, 0_s);
  int smooth = 0, corners = 0;
  for (SimTime t{0}; t < 600_s; t += 100_ms) {  // steered as by an autopilot: a little each time, and now and then much
    auv.advance(t);
    const double s = seconds(t), leg = std::floor(s / 50.0);
    auv.command(0.5 + leg + 0.02 * std::sin(0.7 * s), 1.5 + 0.5 * std::sin(leg), 12.0 + 10.0 * std::sin(0.05 * s));
    const SimTime now = t + 37_ms, h = std::chrono::microseconds(100);
    const auto at = [&](SimTime when) {
      auv.advance(when);
      return auv.moving();
    };
    const frames::MovingPose before = at(now - h), pose = at(now), after = at(now + h);
    // Accelerations are in steps: a corner between the three is no derivative of anything.
    const double turn = (after.angular_acceleration_body_radps2 - before.angular_acceleration_body_radps2).norm();
    if (turn > 1e-3 || (after.acceleration_enu_mps2 - before.acceleration_enu_mps2).norm() > 1e-3) {
      ++corners;
      continue;
    }
    ++smooth;
    const double twice_s = 2e-4;
    const Vec3 velocity = (after.pose.position_enu_m - before.pose.position_enu_m) / twice_s;
    const Vec3 acceleration = (after.velocity_enu_mps - before.velocity_enu_mps) / twice_s;
    const Eigen::AngleAxisd turned(before.pose.enu_from_body.conjugate() * after.pose.enu_from_body);
    const Vec3 spin = (after.angular_rate_body_radps - before.angular_rate_body_radps) / twice_s;
    // Rounding of a place 1 km away is 1e-13 m, over 0.2 ms 1e-9 m/s. Where the speed changes in a turn each step of h
    // gains on the rate of its start at the highest turn acceleration: speed times (a h / 2 R)^2 / (2 alpha h), 1e-8.
    CAPTURE(s);
    CHECK((velocity - pose.velocity_enu_mps).norm() < 3e-8);
    CHECK((acceleration - pose.acceleration_enu_mps2).norm() < 3e-8);
    CHECK((turned.axis() * turned.angle() / twice_s - pose.angular_rate_body_radps).norm() < 3e-8);
    CHECK((spin - pose.angular_acceleration_body_radps2).norm() < 3e-8);
  }
  CHECK(smooth > 5700);
  CHECK(corners > 0);
}

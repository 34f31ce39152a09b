// What tide, current, loading and disturbance do to a vehicle.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "components/vehicle/kinematic/kinematic.h"
#include "components/vehicle/model.h"
#include "components/vehicle/testing/integrated.h"
#include "kernels/vehicle/motion/disturbance.h"

using namespace ensonify;
using Catch::WithinAbs;
using frames::Vec3;
constexpr double kPi = std::numbers::pi;

namespace {

constexpr double kM2_radps = 1.405189e-4;

VehicleConfig in_a_tide() {
  VehicleConfig config;
  config.limits.turning_radius_m = 20;
  config.fastest_mps = 6;
  config.water.tide = vertical::Tide(vertical::HarmonicTide{2.0, {{kM2_radps, 1.5, 0.0}}});
  return config;
}

}  // namespace

TEST_CASE("a boat rides the tide and sinks with speed and load") {
  VehicleConfig config = in_a_tide();
  config.water.floats = vertical::Loading{{{0, 0.0}, {4, 0.1}}, 0.02, 0.0};
  KinematicDynamics boat(config, {{0, 0, 0}, 0.0, 2.0}, 0_s);
  CHECK(boat.moving().pose.position_enu_m.z() == Approx(3.5 - 0.05 - 0.02));
  const double low_s = kPi / kM2_radps;
  boat.advance(from_seconds(low_s));
  CHECK(boat.moving().pose.position_enu_m.z() == Approx(0.5 - 0.07));
}

TEST_CASE("an AUV holds its depth below the water, not below datum") {
  KinematicDynamics auv(in_a_tide(), {{0, 0, -10}, 0.0, 2.0}, 0_s);
  auv.advance(from_seconds(0.5 * kPi / kM2_radps));
  CHECK(auv.moving().pose.position_enu_m.z() == Approx(2.0 - 10.0));
  CHECK(auv.moving().velocity_enu_mps.z() == Approx(-1.5 * kM2_radps));
}

TEST_CASE("a current carries a vehicle, by its depth") {
  VehicleConfig config = in_a_tide();
  config.water.tide = {};
  config.water.current.profile = {{0.0, {0.6, 0.0}}, {10.0, {0.2, 0.0}}};
  KinematicDynamics auv(config, {{0, 0, -5}, 0.0, 2.0}, 0_s);
  auv.advance(100_s);
  CHECK((auv.moving().pose.position_enu_m - Vec3(40, 200, -5)).norm() < 1e-9);
  CHECK((auv.moving().velocity_enu_mps - Vec3(0.4, 2.0, 0)).norm() < 1e-12);
}

TEST_CASE("velocity and acceleration of a vehicle in water are derivatives of its pose") {
  VehicleConfig config = in_a_tide();
  config.water.floats = vertical::Loading{{{0, 0.0}, {9, 0.3}}, 0.0, -1e-6};
  config.water.current.profile = {{0.0, {0.3, 0.2}}};
  config.water.current.streams = {{{0.5, 0.1}, kM2_radps, 0.4}};
  config.disturbance.roll = {.oscillation_sd = 0.05, .period_s = 5};
  config.disturbance.heave = {.oscillation_sd = 0.4, .period_s = 6, .wander_sd = 0.02};
  config.disturbance.surge = {.wander_sd = 0.1, .hurst = 0.6};
  config.waves.heave_m = {0.2, 7.0, 0.0};
  VehicleModel boat(config, {{0, 0, 0}, 0.0, 2.0}, 0_s);
  boat.command({0, 2.0, 5.0});
  const auto vec = [](const std::array<double, 3>& v) { return Vec3(v[0], v[1], v[2]); };
  boat.advance(3_s);
  const msg::Pose before = boat.pose();
  boat.advance(3_s + 1_ms);
  const msg::Pose now = boat.pose();
  boat.advance(3_s + 2_ms);
  const msg::Pose after = boat.pose();
  // Over 2 ms a difference errs by its third derivative times h^2 / 6: below 1e-6 for motion below 2 Hz.
  const Vec3 velocity = (vec(after.position_enu_m) - vec(before.position_enu_m)) / 2e-3;
  CHECK((velocity - vec(now.velocity_enu_mps)).norm() < 2e-6);
  const Vec3 acceleration = (vec(after.velocity_enu_mps) - vec(before.velocity_enu_mps)) / 2e-3;
  CHECK((acceleration - vec(now.acceleration_enu_mps2)).norm() < 1e-5);
  CHECK(std::abs(now.acceleration_enu_mps2[2]) > 0.01);
}

TEST_CASE("600 s of a vehicle's accelerations and rates, in tide and stream, give its pose") {
  VehicleConfig config = in_a_tide();
  config.water.floats = vertical::Loading{{{0, 0.0}, {9, 0.3}}, 0.0, -1e-6};
  config.water.current.profile = {{0.0, {0.3, 0.2}}};
  config.water.current.streams = {{{0.5, 0.1}, kM2_radps, 0.4}};
  config.disturbance = *motion::disturbance_preset("research_ship");
  VehicleModel boat(config, {{0, 0, 0}, 0.5, 2.0}, 0_s);
  const auto vec = [](const std::array<double, 3>& v) { return Vec3(v[0], v[1], v[2]); };
  const Off off = integrated(
      600_s, 40_ms, [](SimTime) {},
      [&](SimTime t) {
        boat.advance(t);
        const msg::Pose pose = boat.pose();
        return frames::MovingPose{{vec(pose.position_enu_m), frames::quaternion_of(pose.enu_from_body)},
                                  vec(pose.velocity_enu_mps),
                                  vec(pose.rate_body_radps),
                                  vec(pose.acceleration_enu_mps2),
                                  vec(pose.angular_acceleration_body_radps2)};
      });
  CHECK(off.position_m.norm() < 1e-3);
  CHECK(off.attitude_rad < 1e-3 * kPi / 180);
}

TEST_CASE("a ramp of speed makes no vertical step; acceleration integrates to settlement") {
  VehicleConfig config = in_a_tide();
  config.water.tide = {};
  config.limits.acceleration_mps2 = 0.3;
  config.water.floats = vertical::Loading{{{0, 0.0}, {2, 0.02}, {5, 0.11}}, 0.0, 0.0};
  KinematicDynamics boat(config, {{0, 0, 0}, 0.0, 1.0}, 0_s);
  boat.command(0.0, 4.0, std::nullopt);  // 10 s
  double height_m = boat.moving().pose.position_enu_m.z(), climb_mps = 0.0, before_mps2 = 0.0;
  constexpr double h = 0.01;
  for (SimTime t = 10_ms; t <= 30_s; t += 10_ms) {
    boat.advance(t);
    const double now_mps2 = boat.moving().acceleration_enu_mps2.z();
    height_m += h * climb_mps + h * h / 6 * (2 * before_mps2 + now_mps2);
    climb_mps += 0.5 * h * (before_mps2 + now_mps2);
    before_mps2 = now_mps2;
  }
  CHECK_THAT(boat.moving().pose.position_enu_m.z(), WithinAbs(-0.08, 1e-6));  // of 4 m/s
  CHECK_THAT(height_m, WithinAbs(boat.moving().pose.position_enu_m.z(), 1e-4));
}

TEST_CASE("two vehicles of one scenario are disturbed differently") {
  VehicleConfig a = in_a_tide();
  a.disturbance.roll = {.oscillation_sd = 0.05, .period_s = 5};
  a.name = "a";
  VehicleConfig b = a;
  b.name = "b";
  const VehicleModel first(a, {}, 0_s), again(a, {}, 0_s), second(b, {}, 0_s);
  CHECK(first.pose().enu_from_body == again.pose().enu_from_body);
  CHECK(first.pose().enu_from_body != second.pose().enu_from_body);
}

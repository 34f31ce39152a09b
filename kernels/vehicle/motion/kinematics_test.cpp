#include "kernels/vehicle/motion/kinematics.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify::motion;
using Catch::WithinAbs;
using ensonify::frames::attitude_of;
using ensonify::frames::Vec3;
constexpr double kPi = std::numbers::pi;
const Limits kLimits{
    .acceleration_mps2 = 0.5, .deceleration_mps2 = 0.25, .turning_radius_m = 20, .vertical_speed_mps = 0.5};

TEST_CASE("a ramp takes v/a seconds and v^2/2a metres") {
  const Ramp up = speed_ramp(0.0, 2.0, 4.0, kLimits);
  CHECK(up.speed_mps == 2.0);
  CHECK(up.distance_m == Approx(4.0));
  CHECK(speed_ramp(0.0, 2.0, 10.0, kLimits).distance_m == Approx(4.0 + 2.0 * 6.0));
  CHECK(stopping_distance_m(2.0, kLimits) == Approx(8.0));
  const Ramp stop = speed_ramp(2.0, 0.0, 100.0, kLimits);
  CHECK(stop.speed_mps == 0.0);
  CHECK(stop.distance_m == Approx(8.0));
}

TEST_CASE("a half turn ends two radii to starboard with the opposite heading") {
  const State start{Vec3(5, 7, 0), 0.0, 2.0};
  const double half_turn_s = kPi * 20.0 / 2.0;
  const State end = advance(start, {kPi, 2.0, 0.0}, half_turn_s, kLimits);
  CHECK((end.position_enu_m - Vec3(45, 7, 0)).norm() < 1e-9);
  CHECK(end.heading_rad == Approx(kPi));
}

TEST_CASE("the shorter way round is taken, across north too") {
  const State start{Vec3::Zero(), 10 * kPi / 180, 2.0};
  const State end = advance(start, {350 * kPi / 180, 2.0, 0.0}, 1.0, kLimits);
  CHECK(end.heading_rad == Approx(10 * kPi / 180 - 0.1));
}

TEST_CASE("one long step equals many short ones, for speed, turn, climb and path") {
  const State start{Vec3(1, 2, -3), 0.4, 0.2};
  const Command command{3.3, 1.7, -9.0};
  const State once = advance(start, command, 40.0, kLimits);
  State often = start;
  for (int i = 0; i < 4000; ++i) often = advance(often, command, 0.01, kLimits);
  CHECK((once.position_enu_m - often.position_enu_m).norm() < 1e-9);
  CHECK_THAT(once.heading_rad, WithinAbs(often.heading_rad, 1e-12));
  CHECK(once.speed_mps == often.speed_mps);
  CHECK(once.position_enu_m.z() == -9.0);
}

TEST_CASE("at rest nothing turns") {
  const State still = advance({Vec3::Zero(), 1.0, 0.0}, {2.0, 0.0, 0.0}, 60.0, kLimits);
  CHECK(still.heading_rad == 1.0);
  CHECK(still.position_enu_m == Vec3::Zero());
}

namespace {

const Limits kSlowTurner{.acceleration_mps2 = 0.5,
                         .deceleration_mps2 = 0.25,
                         .turning_radius_m = 20,
                         .turn_rate_radps = 0.1,  // binds above 2 m/s
                         .vertical_speed_mps = 0.5,
                         .vertical_acceleration_mps2 = 0.2};

}  // namespace

TEST_CASE("a limited turn rate widens the circle to v/omega") {
  CHECK(turn_rate_radps(1.0, kSlowTurner) == Approx(0.05));
  CHECK(turn_rate_radps(5.0, kSlowTurner) == Approx(0.1));
  CHECK(turning_circle_m(1.0, kSlowTurner) == 20.0);
  CHECK(turning_circle_m(5.0, kSlowTurner) == Approx(50.0));
  const State end = advance({Vec3::Zero(), 0.0, 5.0}, {kPi, 5.0, 0.0}, kPi / 0.1, kSlowTurner);
  CHECK((end.position_enu_m - Vec3(100, 0, 0)).norm() < 1e-9);
}

TEST_CASE("steps add up where both limits and a ramp take turns") {
  const State start{Vec3(1, 2, -3), 0.4, 0.2};
  const Command command{3.3, 4.7, -9.0};
  for (const double until_s : {2.0, 6.0, 40.0}) {
    const State once = advance(start, command, until_s, kSlowTurner);
    State often = start;
    for (int i = 0; i < 1000; ++i) often = advance(often, command, until_s / 1000.0, kSlowTurner);
    CHECK((once.position_enu_m - often.position_enu_m).norm() < 1e-9);
    CHECK_THAT(once.heading_rad, WithinAbs(often.heading_rad, 1e-12));
    CHECK_THAT(once.speed_mps, WithinAbs(often.speed_mps, 1e-12));
    CHECK_THAT(once.climb_mps, WithinAbs(often.climb_mps, 1e-9));
  }
}

namespace {

/// Builds up its turn as a launch does.
const Limits kLaunch{
    .acceleration_mps2 = 0.5, .deceleration_mps2 = 0.25, .turning_radius_m = 20, .turn_acceleration_radps2 = 0.1};

}  // namespace

TEST_CASE("a half turn takes pi/omega + omega/alpha, its path the integral of heading") {
  const double rate = 0.2, half_turn_s = kPi / rate + rate / 0.1;  // 4 m/s on 20 m
  const State start{Vec3(5, 7, 0), 0.0, 4.0};
  CHECK(advance(start, {kPi - 1e-9, 4.0, 0.0}, half_turn_s - 0.01, kLaunch).turn_radps == Approx(0.001).epsilon(1e-3));
  const State end = advance(start, {kPi - 1e-9, 4.0, 0.0}, half_turn_s + 1e-9, kLaunch);
  CHECK_THAT(end.heading_rad, WithinAbs(kPi - 1e-9, 1e-9));
  CHECK_THAT(end.turn_radps, WithinAbs(0.0, 1e-9));
  // Symmetric about its middle: it ends abeam of where it began turning, were it not for the way there and back. The
  // integral of sin(heading) by the midpoint rule in steps of 10 us, 1e-9 m.
  double abeam_m = 0.0;
  constexpr double h = 1e-5;
  for (double t = 0.5 * h; t < half_turn_s; t += h) {
    const double up_s = std::min({t, half_turn_s - t, rate / 0.1});
    const double from_end = 0.5 * 0.1 * up_s * up_s + (std::min(t, half_turn_s - t) - up_s) * rate;
    abeam_m += 4.0 * std::sin(from_end) * h;  // sin(pi - heading) = sin(heading)
  }
  CHECK_THAT(end.position_enu_m.x() - 5.0, WithinAbs(abeam_m, 1e-5));
  CHECK_THAT(end.position_enu_m.y(), WithinAbs(7.0, 1e-5));
  CHECK(abeam_m > 40.0);  // wider than the circle
}

TEST_CASE("steps of a turn with inertia add up, at a constant speed and with a changing one") {
  for (const double speed_mps : {1.7, 0.2}) {
    const State start{Vec3(1, 2, 0), 0.4, speed_mps};
    const Command command{3.3, 1.7, 0.0};
    const State once = advance(start, command, 40.0, kLaunch);
    State often = start;
    for (int i = 0; i < 5714; ++i) often = advance(often, command, 0.007, kLaunch);
    often = advance(often, command, 0.002, kLaunch);
    CHECK((once.position_enu_m - often.position_enu_m).norm() < (speed_mps == 1.7 ? 1e-6 : 1e-3));
    CHECK_THAT(once.heading_rad, WithinAbs(often.heading_rad, 1e-9));
    CHECK_THAT(once.speed_mps, WithinAbs(often.speed_mps, 1e-9));
  }
}

TEST_CASE("a vehicle with inertia that stops in a turn stops turning") {
  const State stopped = advance({Vec3::Zero(), 0.0, 2.0}, {3.0, 0.0, 0.0}, 20.0, kLaunch);
  CHECK(stopped.speed_mps == 0.0);
  CHECK(stopped.turn_radps == 0.0);
  CHECK(stopped.heading_rad > 0.1);
  CHECK(stopped.heading_rad <= 8.0 / 20.0);  // its way over the radius
  CHECK(advance(stopped, {3.0, 0.0, 0.0}, 20.0, kLaunch).heading_rad == stopped.heading_rad);
}

namespace {

/// How far the sum of turn rates, read a hundred times a second, is from the heading after ten minutes of line
/// following: ten orders a second, each some thousandths of a degree from the last. rad
double turn_rates_miss_by(const Limits& limits) {
  State state{Vec3::Zero(), 1.0, 4.0};
  Command command{1.0, 4.0, 0.0};
  double turned_rad = 0.0;
  for (int i = 0; i < 60000; ++i) {
    if (i % 10 == 0) command.heading_rad = 1.0 + 1e-4 * std::sin(0.7 * i) + 1e-6 * i;
    const auto rate = [&] { return moving_pose(state, command, limits).angular_rate_body_radps.z(); };
    const double before = rate();
    state = advance(state, command, 0.01, limits);
    turned_rad += 0.005 * (before + rate());
  }
  CHECK_THAT(state.heading_rad, WithinAbs(1.06, 2e-4));
  return std::abs(turned_rad - (state.heading_rad - 1.0));
}

}  // namespace

TEST_CASE("turn rates of a vehicle with inertia that is steered sum to its heading") {
  CHECK(turn_rates_miss_by(kLaunch) < 3e-4);  // of 0.6 rad turned to and fro, by corners of the rate between readings
  // One that turns at once is read at its full rate when it is asked, and has turned a moment later.
  Limits at_once = kLaunch;
  at_once.turn_acceleration_radps2 = kUnlimited;
  CHECK(turn_rates_miss_by(at_once) > 0.1);
}

TEST_CASE("velocity, acceleration and turn rates are the derivatives of the pose") {
  const Waves waves{{0.1, 8.0, 0.3}, {0.5, 6.0, 1.0}};
  const Command command{2.0, 3.0, 4.0};
  Limits inert = kSlowTurner;
  inert.turn_acceleration_radps2 = 0.05;
  const auto check = [&](const Limits& limits, double speed_mps, double turn_radps) {
    const State state{Vec3(0, 0, 0), 0.5, speed_mps, 0.1, turn_radps};
    const double t = 12.3, h = 1e-3;
    const auto at = [&](double dt) {
      return superimpose(moving_pose(advance(state, command, dt, limits), command, limits), waves.at(t + dt));
    };
    // Differences over 2 h = 2 ms: their error is the third derivative times h^2 / 6, of the order of 1e-7.
    const auto before = at(0.0), now = at(h), later = at(2.0 * h);
    const Vec3 velocity = (later.pose.position_enu_m - before.pose.position_enu_m) / (2.0 * h);
    CHECK((velocity - now.velocity_enu_mps).norm() < 1e-6);
    const Vec3 acceleration = (later.velocity_enu_mps - before.velocity_enu_mps) / (2.0 * h);
    CHECK((acceleration - now.acceleration_enu_mps2).norm() < 1e-6);
    const Eigen::AngleAxisd turn(before.pose.enu_from_body.conjugate() * later.pose.enu_from_body);
    CHECK((turn.axis() * turn.angle() / (2.0 * h) - now.angular_rate_body_radps).norm() < 1e-6);
    const Vec3 spin = (later.angular_rate_body_radps - before.angular_rate_body_radps) / (2.0 * h);
    CHECK((spin - now.angular_acceleration_body_radps2).norm() < 1e-6);
  };
  check(kSlowTurner, 1.5, 0.0);  // the radius limits the turn
  check(kSlowTurner, 2.5, 0.0);  // the rate does
  check(inert, 2.5, 0.04);       // its inertia does
  check(inert, 2.5, 0.1);
}

TEST_CASE("waves roll to their amplitude and no further") {
  const Waves waves{{0.1, 8.0, 0.0}, {0.5, 6.0, 0.0}};
  CHECK(attitude_of(superimpose({}, waves.at(2.0)).pose.enu_from_body).roll_rad == Approx(0.1));
  CHECK(superimpose({}, waves.at(1.5)).pose.position_enu_m.z() == Approx(0.5));
}

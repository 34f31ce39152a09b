#include "kernels/motion/kinematics.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify::motion;
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
  CHECK(once.heading_rad == Approx(often.heading_rad).margin(1e-12));
  CHECK(once.speed_mps == often.speed_mps);
  CHECK(once.position_enu_m.z() == -9.0);
}

TEST_CASE("at rest nothing turns") {
  const State still = advance({Vec3::Zero(), 1.0, 0.0}, {2.0, 0.0, 0.0}, 60.0, kLimits);
  CHECK(still.heading_rad == 1.0);
  CHECK(still.position_enu_m == Vec3::Zero());
}

TEST_CASE("velocity and turn rate are the derivatives of the pose") {
  const Waves waves{{0.1, 8.0, 0.3}, {0.5, 6.0, 1.0}};
  const Command command{2.0, 2.0, 4.0};
  const State state{Vec3(0, 0, 0), 0.5, 2.0};
  const double t = 12.3, h = 1e-5;
  const auto now = moving_pose(state, command, waves, t, kLimits);
  const auto later = moving_pose(advance(state, command, h, kLimits), command, waves, t + h, kLimits);
  const Vec3 velocity = (later.pose.position_enu_m - now.pose.position_enu_m) / h;
  CHECK((velocity - now.velocity_enu_mps).norm() < 1e-4);
  const Eigen::AngleAxisd turn(now.pose.enu_from_body.conjugate() * later.pose.enu_from_body);
  CHECK((turn.axis() * turn.angle() / h - now.angular_rate_body_radps).norm() < 1e-4);
}

TEST_CASE("waves roll to their amplitude and no further") {
  const Waves waves{{0.1, 8.0, 0.0}, {0.5, 6.0, 0.0}};
  const auto crest = moving_pose({}, {}, waves, 2.0, kLimits);
  CHECK(attitude_of(crest.pose.enu_from_body).roll_rad == Approx(0.1));
  CHECK(moving_pose({}, {}, waves, 1.5, kLimits).pose.position_enu_m.z() == Approx(0.5));
}

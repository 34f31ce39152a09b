#include "kernels/water/refraction/path.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/water/refraction/thermocline.h"

using namespace ensonify::refraction;
using Catch::Matchers::WithinAbs;
constexpr double kDeg = std::numbers::pi / 180;

static Path launch(const SoundSpeedProfile& profile, double depth_m, double depression_rad) {
  return Path(profile, depth_m, std::sin(depression_rad), std::cos(depression_rad));
}

TEST_CASE("in uniform water a path is straight and spreads with the square of distance") {
  const auto profile = SoundSpeedProfile::uniform(1500);
  for (const double degrees : {-90.0, -30.0, 0.0, 15.0, 89.0, 90.0}) {
    Path path = launch(profile, 10, degrees * kDeg);
    CHECK(path.leg_within().endless() == (degrees >= 0));  // above 0 m begins another layer of the same water
    path.take(path.leg_of_length(40));
    path.take(path.leg_of_time(60 / 1500.0));
    CHECK(path.at().length_m == Approx(100));
    CHECK(path.at().time_s == Approx(100 / 1500.0));
    CHECK(path.at().depth_m == Approx(10 + 100 * std::sin(degrees * kDeg)));
    CHECK_THAT(path.horizontal_m(), WithinAbs(100 * std::cos(degrees * kDeg), 1e-9));
    CHECK(path.tube_m2() == Approx(1e4));
  }
}

TEST_CASE("legs by depth, length, time and horizontal distance are the same arc") {
  const SoundSpeedProfile profile({{0, 1480}, {100, 1520}});
  for (const double degrees : {-60.0, -8.0, 0.0, 3.0, 45.0, 89.9}) {  // some of them turn within 30 m
    Path path = launch(profile, 50, degrees * kDeg);
    const Leg leg = path.leg_of_length(30);
    const double time = path.time_of(leg), across = leg.chord_m * leg.chord_cosine;
    CHECK(path.length_of(leg) == Approx(30).epsilon(1e-13));
    for (const Leg& other : {path.leg_of_time(time), path.leg_of_horizontal(across)}) {
      CHECK(other.chord_m == Approx(leg.chord_m).epsilon(1e-10));
      CHECK(other.end_depth_m == Approx(leg.end_depth_m).epsilon(1e-11));
      CHECK_THAT(other.end_sine, WithinAbs(leg.end_sine, 1e-12));
      CHECK(other.end_speed_mps == Approx(leg.end_speed_mps).epsilon(1e-12));
    }
    if (degrees != -8 && degrees != 0 && degrees != 3) {
      const Leg to_depth = degrees < 0 ? path.leg_within(leg.end_depth_m) : path.leg_within(0, leg.end_depth_m);
      CHECK(to_depth.chord_m == Approx(leg.chord_m).epsilon(1e-10));
    }
  }
}

TEST_CASE("a path bends towards slower water on a circle and turns where Snell's law says") {
  const double g = 0.4;
  const SoundSpeedProfile profile({{0, 1480}, {100, 1480 + 100 * g}});
  Path path = launch(profile, 20, 10 * kDeg);
  const double c0 = profile.speed_mps(20), radius = c0 / (g * std::cos(10 * kDeg));
  const Leg leg = path.leg_within();
  REQUIRE(leg.turns);
  const double turning = 20 + radius * (1 - std::cos(10 * kDeg));
  CHECK(path.turning_depth_m() == Approx(turning));
  CHECK(profile.speed_mps(turning) == Approx(c0 / std::cos(10 * kDeg)));

  // Up to the top of the layer, about the circle's centre at depth 20 - radius cos(10 deg).
  const double end_angle = -std::acos(1480 * std::cos(10 * kDeg) / c0);
  path.take(leg);
  CHECK(path.at().depth_m == 0);
  CHECK(path.at().sine == Approx(std::sin(end_angle)));
  CHECK(path.horizontal_m() == Approx(radius * (std::sin(10 * kDeg) - std::sin(end_angle))));
  CHECK(path.at().length_m == Approx(radius * (10 * kDeg - end_angle)));
  CHECK(path.at().time_s == Approx((std::atanh(std::sin(10 * kDeg)) - std::atanh(std::sin(end_angle))) / g));
}

TEST_CASE("a vertical path takes the integral of slowness") {
  const SoundSpeedProfile profile({{0, 1480}, {100, 1520}});
  Path path(profile, 0, 1, 0);
  path.take(path.leg_within());
  CHECK(path.at().depth_m == 100);
  CHECK(path.horizontal_m() == 0);
  CHECK(path.at().time_s == Approx(std::log(1520.0 / 1480) / 0.4).epsilon(1e-13));
  // Rays near the vertical: dx/dtheta = integral of c dz / c0, on both axes.
  CHECK(path.tube_m2() == Approx(std::pow(1500.0 * 100 / 1480, 2)));
}

TEST_CASE("Snell's invariant holds over knots, turns and layers") {
  const auto profile = summer_thermocline();
  for (double degrees = -88; degrees < 89; degrees += 1.7) {
    Path path = launch(profile, 22, degrees * kDeg);
    for (int leg = 0; leg < 30 && !path.leg_within().endless(); ++leg) {
      path.take(path.leg_within());
      REQUIRE(path.at().cosine / path.at().speed_mps == Approx(path.invariant_spm()).epsilon(1e-12));
      REQUIRE(path.at().speed_mps == Approx(profile.speed_mps(path.at().depth_m)).epsilon(1e-13));
      REQUIRE(std::hypot(path.at().sine, path.at().cosine) == Approx(1).epsilon(1e-12));
    }
  }
}

TEST_CASE("sound that leaves along the axis of a channel stays on it") {
  const SoundSpeedProfile channel({{0, 1510}, {50, 1490}, {100, 1510}});
  for (const double degrees : {0.0, 1e-4}) {
    const Path axis = launch(channel, 50, degrees * kDeg);
    CHECK(axis.leg_within().endless());
  }
  Path path = launch(channel, 50, 2 * kDeg);  // oscillates about it: R (1 - cos) is 2.27 m
  for (int turn = 0; turn < 8; ++turn) {
    const Leg leg = path.leg_within();
    REQUIRE(leg.turns);
    CHECK(std::abs(path.turning_depth_m() - 50) == Approx(1490 / 0.4 * (1 / std::cos(2 * kDeg) - 1)));
    path.take(leg);
    CHECK(path.at().depth_m == 50);
  }
  // Off a ridge of speed it falls to either side; on it, it takes the lower one.
  const SoundSpeedProfile ridge({{0, 1490}, {50, 1510}, {100, 1490}});
  CHECK(launch(ridge, 50, 0).heads_down());
  CHECK_FALSE(launch(ridge, 49.9, 0).heads_down());
}

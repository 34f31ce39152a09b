#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/survey/boresight/adjust.h"

using namespace ensonify::boresight;
using Catch::WithinAbs;
using ensonify::frames::Attitude;
using ensonify::frames::enu_from_body;

namespace {

constexpr double kDegree = M_PI / 180.0;

/// A level head at the surface that goes north, and its sounding at this place.
Sounding heading_north(const Vec3& place) {
  return {.place_enu_m = place, .enu_from_body = enu_from_body(Attitude{}), .velocity_enu_mps = {0, 4, 0}};
}

}  // namespace

TEST_CASE("roll rotates soundings about the track: 3.5 deg at 60 deg in 30 m are 3.23 m") {  // PHYSICS.md, 12
  const double x = 30.0 * std::tan(60 * kDegree), dr = 3.5 * kDegree;
  const Vec3 port = place(heading_north({-x, 0, -30}), {.roll_rad = dr}).place_enu_m;
  const Vec3 starboard = place(heading_north({x, 0, -30}), {.roll_rad = dr}).place_enu_m;
  // Starboard goes down by x sin dr + z (cos dr - 1) with z = -30, depth negative.
  CHECK(starboard.z() + 30.0 == Approx(-x * std::sin(dr) - 30.0 * (std::cos(dr) - 1.0)));
  CHECK_THAT(starboard.z() + 30.0, WithinAbs(-3.116, 0.001));
  CHECK(port.z() + 30.0 == Approx(x * std::sin(dr) + 30.0 * (1.0 - std::cos(dr))));
  CHECK_THAT(port.z() + 30.0, WithinAbs(3.228, 0.001));  // the table's 3.23 m
}

TEST_CASE("pitch, yaw and latency move a sounding along the track") {
  const double d = 0.5 * kDegree;
  const Vec3 nadir(0, 0, -30), outer(40, 0, -30);
  CHECK(place(heading_north(nadir), {.pitch_rad = d}).place_enu_m.y() ==
        Approx(30.0 * std::sin(d)));  // bow up points ahead
  CHECK(place(heading_north(outer), {.yaw_rad = d}).place_enu_m.y() ==
        Approx(-40.0 * std::sin(d)));  // to starboard: aft there
  CHECK(place(heading_north(outer), {.position_latency_s = 0.2}).place_enu_m.y() == Approx(0.8));
  Sounding rolling = heading_north(outer);
  rolling.rate_enu_radps = Vec3(0, 0.1, 0);  // about the bow's axis: starboard down
  CHECK(place(rolling, {.attitude_latency_s = 0.05}).place_enu_m.z() ==
        Approx(place(rolling, {.roll_rad = 0.005}).place_enu_m.z()));
}

TEST_CASE("a mounting turns with the vehicle") {
  Sounding east = heading_north({0, -40, -30});  // starboard of a boat that goes east
  east.enu_from_body = enu_from_body(Attitude{.heading_rad = M_PI / 2});
  const Vec3 turned = place(east, {.roll_rad = 0.01}).place_enu_m;
  CHECK(turned.z() < -30.0 - 0.39);
  CHECK_THAT(turned.x(), WithinAbs(0.0, 1e-12));
}

TEST_CASE("rates are the derivatives of the place") {
  Sounding s = heading_north({41, 7, -33});
  s.head_enu_m = Vec3(1, 2, -0.5);
  s.enu_from_body = enu_from_body({.heading_rad = 0.7, .pitch_rad = -0.1, .roll_rad = 0.2});
  s.rate_enu_radps = Vec3(0.03, -0.08, 0.02);
  const std::array<double, 5> at = {0.3, 0.02, 0.05, -0.04, 0.07};
  const auto offsets = [](const std::array<double, 5>& o) { return Offsets{o[0], o[1], o[2], o[3], o[4]}; };
  const Placed placed = place(s, offsets(at));
  for (std::size_t k = 0; k < 5; ++k) {
    std::array<double, 5> up = at, down = at;
    up[k] += 1e-4;
    down[k] -= 1e-4;
    const Vec3 rate = (place(s, offsets(up)).place_enu_m - place(s, offsets(down)).place_enu_m) / 2e-4;
    CHECK((rate - placed.rates.col(static_cast<Eigen::Index>(k))).norm() < 1e-6);  // third derivative x 50 m x 1e-8 / 6
  }
}

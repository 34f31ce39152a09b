#include "kernels/vehicle/runlines/runline.h"

#include <catch2/catch.hpp>
#include <numbers>

using namespace ensonify::runlines;
constexpr double kPi = std::numbers::pi;

TEST_CASE("a place east of a line run to north lies to starboard") {
  const Runline line{{10, 0}, {10, 100}};
  CHECK(heading_rad(line) == 0.0);
  CHECK(line_position(line, {13, 40}).along_m == Approx(40));
  CHECK(line_position(line, {13, 40}).cross_track_m == Approx(3));
  CHECK(line_position(reversed(line), {13, 40}).cross_track_m == Approx(-3));
  CHECK((point_on(line, 110) - Vec2(10, 110)).norm() < 1e-12);
}

TEST_CASE("on the line the command is its heading, one lookahead off it is 45 degrees") {
  const Runline line{{0, 0}, {100, 0}};
  CHECK(line_of_sight_heading_rad(line, {50, 0}, 20) == Approx(kPi / 2));
  CHECK(line_of_sight_heading_rad(line, {50, 20}, 20) == Approx(3 * kPi / 4));  // to port of it: turn to starboard
  CHECK(line_of_sight_heading_rad(line, {50, -20}, 20) == Approx(kPi / 4));
}

TEST_CASE("steering by line of sight closes on the line without crossing it") {
  const Runline line{{0, 0}, {0, 500}};
  Vec2 position(30, 0);
  double before = 30;
  for (int i = 0; i < 300; ++i) {
    const double heading = line_of_sight_heading_rad(line, position, 20);
    position += Vec2(std::sin(heading), std::cos(heading));
    const double cross = line_position(line, position).cross_track_m;
    REQUIRE(cross >= 0);
    REQUIRE(cross < before);
    before = cross;
  }
  CHECK(before < 0.01);
}

TEST_CASE("a lawnmower pattern is centred, evenly spaced and run to and fro") {
  const auto lines = lawnmower({100, 50}, 0.0, 400, 30, 5);
  REQUIRE(lines.size() == 5);
  CHECK((lines[0].start_enu_m - Vec2(40, -150)).norm() < 1e-9);
  CHECK((lines[0].end_enu_m - Vec2(40, 250)).norm() < 1e-9);
  CHECK((lines[1].start_enu_m - Vec2(70, 250)).norm() < 1e-9);
  CHECK((lines[4].end_enu_m - Vec2(160, 250)).norm() < 1e-9);
  CHECK(length_m(extended(lines[2], 10, 5)) == Approx(415));
}

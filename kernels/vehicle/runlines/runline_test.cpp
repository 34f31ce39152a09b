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

TEST_CASE("a lawnmower pattern is centred, evenly spaced and run to and fro") {
  const auto lines = lawnmower({100, 50}, 0.0, 400, 30, 5);
  REQUIRE(lines.size() == 5);
  CHECK((lines[0].start_enu_m - Vec2(40, -150)).norm() < 1e-9);
  CHECK((lines[0].end_enu_m - Vec2(40, 250)).norm() < 1e-9);
  CHECK((lines[1].start_enu_m - Vec2(70, 250)).norm() < 1e-9);
  CHECK((lines[4].end_enu_m - Vec2(160, 250)).norm() < 1e-9);
  CHECK(length_m(extended(lines[2], 10, 5)) == Approx(415));
}

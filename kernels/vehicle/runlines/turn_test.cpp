#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/vehicle/runlines/runline.h"

using namespace ensonify::runlines;
constexpr double kPi = std::numbers::pi;

static void check_arrives(const Turn& turn, const Waypose& to) {
  const Waypose end = turn.at(turn.length_m());
  REQUIRE((end.position_enu_m - to.position_enu_m).norm() < 1e-6);
  REQUIRE(std::abs(ensonify::frames::wrap_pi(end.heading_rad - to.heading_rad)) < 1e-6);
}

TEST_CASE("two lines two radii apart are joined by half a circle") {
  const Waypose from{{0, 0}, 0}, to{{40, 0}, kPi};
  const Turn turn = shortest_turn(from, to, 20);
  CHECK(turn.length_m() == Approx(20 * kPi));
  check_arrives(turn, to);
}

TEST_CASE("straight ahead is straight") {
  const Turn turn = shortest_turn({{0, 0}, kPi / 2}, {{70, 0}, kPi / 2}, 20);
  CHECK(turn.length_m() == Approx(70));
}

TEST_CASE("lines closer than two radii need a bulb of three arcs of known length") {
  // Centres of the outer circles are 2R + s apart for spacing s: length = R (pi + 4 acos((2R + s) / 4R)).
  const double radius = 20, spacing = 15;
  const Waypose from{{0, 0}, 0}, to{{spacing, 0}, kPi};
  const Turn turn = shortest_turn(from, to, radius);
  CHECK(turn.length_m() == Approx(radius * (kPi + 4 * std::acos((2 * radius + spacing) / (4 * radius)))));
  check_arrives(turn, to);
}

TEST_CASE("every turn arrives, never tighter than its radius nor longer than a detour") {
  const double radius = 10;
  for (int i = 0; i < 400; ++i) {
    const double a = i * 0.7391, b = i * 1.311, r = 0.2 * i;
    const Waypose from{{3, -2}, a}, to{{3 + r * std::sin(b), -2 + r * std::cos(b)}, i * 2.03};
    const Turn turn = shortest_turn(from, to, radius);
    check_arrives(turn, to);
    REQUIRE(turn.length_m() >= r - 1e-9);
    REQUIRE(turn.length_m() <= r + 4 * kPi * radius);  // no CSC path is longer than the chord plus two circles
    Waypose previous = turn.at(0);
    for (double s = 0.5; s < turn.length_m(); s += 0.5) {
      const Waypose here = turn.at(s);
      REQUIRE((here.position_enu_m - previous.position_enu_m).norm() <= 0.5 + 1e-9);
      REQUIRE(std::abs(ensonify::frames::wrap_pi(here.heading_rad - previous.heading_rad)) <= 0.5 / radius + 1e-9);
      previous = here;
    }
  }
}

TEST_CASE("a vehicle 3 m off follows a turn of twice its radius and ends on it") {
  const Waypose to{{40, 0}, kPi};
  const Turn turn = shortest_turn({{0, 0}, 0}, to, 20);
  Vec2 position(-3, 0);
  double heading = 0, along = 0;
  while (along < turn.length_m() - 0.25) {  // 0.2 m steps, at most 0.2 / 10 rad each
    along = nearest_along_m(turn, position, along, 5.0);
    const double command = follow_heading_rad(turn, position, along, 5.0);
    heading += std::clamp(ensonify::frames::wrap_pi(command - heading), -0.02, 0.02);
    position += 0.2 * Vec2(std::sin(heading), std::cos(heading));
  }
  CHECK(std::abs(position.x() - to.position_enu_m.x()) < 0.1);
}

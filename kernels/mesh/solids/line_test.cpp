#include "kernels/mesh/solids/line.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/mesh/solids/testing/closed.h"

using namespace ensonify;
using namespace ensonify::solids;
using frames::Vec3;

namespace {

double length_of(const std::vector<Vec3>& line) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length_m += (line[i] - line[i - 1]).norm();
  return length_m;
}

}  // namespace

TEST_CASE("a hung rope is a catenary: as long as 2 a sinh(L / 2a), with its sag") {
  // a = 2 m, ends 6 m apart: sag a (cosh 1.5 - 1), length 2 a sinh 1.5.
  const double sag_m = 2.0 * (std::cosh(1.5) - 1.0);
  const auto line = catenary(6.0, sag_m, 1e-4);
  CHECK((line.front() - Vec3(0, -3, 0.5 * sag_m)).norm() < 1e-9);
  CHECK((line.back() - Vec3(0, 3, 0.5 * sag_m)).norm() < 1e-9);
  CHECK(length_of(line) == Approx(4.0 * std::sinh(1.5)).epsilon(1e-4));
  for (const Vec3& at : line) CHECK(at.z() == Approx(2.0 * (std::cosh(0.5 * at.y()) - 1.0) - 0.5 * sag_m).margin(1e-9));
  // Between its points it leaves the curve by no more than the sagitta.
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec3 middle = 0.5 * (line[i] + line[i - 1]);
    CHECK(middle.z() - 2.0 * (std::cosh(0.5 * middle.y()) - 1.0) + 0.5 * sag_m <=
          1.01e-4 * std::cosh(0.5 * middle.y()));
  }
  CHECK(catenary(6.0, 0.0, 1e-4) == std::vector<Vec3>{{0, -3, 0}, {0, 3, 0}});
}

TEST_CASE("a rope closes, and holds as much as its length times its cross-section") {
  const auto line = catenary(6.0, 1.0, 1e-4);
  const Surface rope = rope_along(line, 0.2, 1e-4);
  CHECK(closes(rope.mesh));
  CHECK(rope.bulge_m.size() == rope.mesh.triangle.size());
  // A ring of n sides has the share sin(2 pi / n) / (2 pi / n) of the circle: within 1 % for these.
  CHECK(volume_m3(rope.mesh) == Approx(length_of(line) * std::numbers::pi * 0.01).epsilon(0.01));
  CHECK(rope_along(std::vector<Vec3>{{0, 0, 0}, {0, 0, 3}}, 0.1, 1e-4).mesh.vertex_m.size() > 16);  // upright too
}

TEST_CASE("links of a chain are six diameters long and 3.6 wide, and hang in each other") {
  const Surface one = chain_along(std::vector<Vec3>{{0, 0, 0}, {0, 0.4, 0}}, 0.1, 1e-4);
  CHECK(closes(one.mesh));
  CHECK((box_of(one.mesh).sizes() - Vec3(0.36, 0.6, 0.1)).norm() < 2e-3);
  const Surface five = chain_along(std::vector<Vec3>{{0, 0, 0}, {0, 2, 0}}, 0.1, 1e-4);
  CHECK(five.mesh.triangle.size() == 5 * one.mesh.triangle.size());
  CHECK(closes(five.mesh));
  CHECK((box_of(five.mesh).sizes() - Vec3(0.36, 2.2, 0.36)).norm() < 4e-3);
  // The middle line of a link is two half circles and two straights. Wire of 16 sides has sin(pi / 8) / (pi / 8) of the
  // circle's area; rounds of eight straight pieces between mitred rings have as much of the round's volume.
  const double cut = std::sin(std::numbers::pi / 8.0) / (std::numbers::pi / 8.0), area_m2 = std::numbers::pi * 0.0025;
  CHECK(volume_m3(one.mesh) ==
        Approx(cut * area_m2 * (2.0 * std::numbers::pi * 0.13 * cut + 4.0 * 0.12)).epsilon(2e-3));
}

TEST_CASE("a taut line spans a trench in a parabola from shoulder to shoulder, a limp one lies in it") {
  std::vector<double> along, ground;
  for (int i = 0; i <= 1000; ++i) {
    along.push_back(0.02 * i);
    ground.push_back(along.back() > 7.0 && along.back() < 13.0 ? -1.0 : 0.0);
  }
  CHECK(laid_heights(along, ground, 0.0) == ground);
  // It hangs by (w / 2)^2 / 2T: 0.09 m below the shoulders, which are 6 m apart (6.02 or so by the spacing).
  const auto taut = laid_heights(along, ground, 50.0);
  for (std::size_t i = 0; i < along.size(); ++i) {
    const double off_m = along[i] - 10.0;
    const double expected = std::abs(off_m) < 3.0 ? 0.5 * (off_m * off_m - 9.0) / 50.0 : 0.0;
    CHECK(taut[i] == Approx(expected).margin(2e-3));
  }
  // With 2 m it would hang 2.25 m deep: it touches the trench's bottom, and leaves it where the parabola's foot is.
  const auto slack = laid_heights(along, ground, 2.0);
  for (std::size_t i = 0; i < along.size(); ++i) {
    CHECK(slack[i] >= ground[i]);
    const double from_wall_m = std::min(along[i] - 7.0, 13.0 - along[i]);
    if (from_wall_m > 2.05) CHECK(slack[i] == Approx(-1.0).margin(1e-9));  // sqrt(2 T depth) = 2 m
    if (from_wall_m > 0.1 && from_wall_m < 1.9)
      CHECK(slack[i] == Approx(0.25 * (2.0 - from_wall_m) * (2.0 - from_wall_m) - 1.0).margin(0.02));
  }
}

TEST_CASE("lines without a size are refused") {
  CHECK_THROWS_WITH(catenary(0.0, 0.1, 1e-3), Catch::Contains("length"));
  CHECK_THROWS_WITH(rope_along(std::vector<Vec3>{{0, 0, 0}}, 0.1, 1e-3), Catch::Contains("two points"));
}

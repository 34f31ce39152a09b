#include "kernels/survey/lines.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify;
using namespace ensonify::survey;
using Catch::WithinAbs;
constexpr double kPi = std::numbers::pi;

namespace {

const Polygon kSquare = {{0, 0}, {400, 0}, {400, 200}, {0, 200}};  // 400 m east, 200 m north
const Swath kSixty{std::acos(0.5), 0.0};

double x_of(const Runline& line) { return line.start_enu_m.x(); }

}  // namespace

TEST_CASE("on level ground lines are two reaches apart, the first one reach from the edge") {
  const auto level = [](const Vec2&) { return 20.0; };
  const auto lines = adapted_lines(kSquare, level, {0.0, kSixty});
  const double reach = 20.0 * std::sqrt(3.0);
  REQUIRE(lines.size() == 6);  // 400 / (2 * 34.64) = 5.8
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    CHECK(x_of(lines[i]) == Approx(reach * (2.0 * static_cast<double>(i) + 1.0)).epsilon(1e-6));
    CHECK(runlines::length_m(lines[i]) == Approx(200.0));
    CHECK_THAT(runlines::heading_rad(lines[i]), WithinAbs(i % 2 == 0 ? 0.0 : kPi, 1e-9));
  }
  CHECK(fixed_lines(kSquare, level, {0.0, kSixty}).size() == lines.size());
}

TEST_CASE("overlap brings lines closer: reach and (1 - overlap) reaches") {
  const auto level = [](const Vec2&) { return 20.0; };
  const auto lines = adapted_lines(kSquare, level, {0.0, {std::acos(0.5), 0.25}});
  CHECK(x_of(lines[2]) - x_of(lines[1]) == Approx(1.75 * 20.0 * std::sqrt(3.0)).epsilon(1e-6));
}

TEST_CASE("down a slope lines spread as the closed form says, and every place is seen") {
  const double g = 0.1, t = std::sqrt(3.0);
  const auto slope = [&](const Vec2& p) { return 10.0 + g * p.x(); };
  const auto lines = adapted_lines(kSquare, slope, {0.0, kSixty});
  const auto fixed = fixed_lines(kSquare, slope, {0.0, kSixty});
  CHECK(lines.size() < 0.6 * static_cast<double>(fixed.size()));
  for (std::size_t i = 2; i + 1 < lines.size(); ++i) {
    CHECK((x_of(lines[i]) - x_of(lines[i - 1])) / (x_of(lines[i - 1]) - x_of(lines[i - 2])) ==
          Approx((1.0 + g * t) / (1.0 - g * t)).epsilon(1e-5));
  }
  for (double x = 0.5; x < 400.0; x += 1.0) {
    const bool seen = std::any_of(lines.begin(), lines.end(), [&](const Runline& line) {
      return std::abs(x - x_of(line)) <= slope({x, 0}) * t * (1.0 + 1e-6);
    });
    CHECK(seen);
  }
}

TEST_CASE("lines are clipped to the area, in pieces where it is concave") {
  const Polygon u = {{0, 0}, {90, 0}, {90, 100}, {60, 100}, {60, 40}, {30, 40}, {30, 100}, {0, 100}};
  const auto lines = spaced_lines(u, 30.0, {0.5 * kPi, kSixty});  // to east, going on to the south
  REQUIRE(lines.size() == 6);
  CHECK(runlines::length_m(lines[0]) == Approx(30.0));
  CHECK((lines[0].start_enu_m - Vec2(0, 87.5)).norm() < 1e-9);
  CHECK((lines[1].start_enu_m - Vec2(60, 87.5)).norm() < 1e-9);
  CHECK((lines[2].start_enu_m - Vec2(90, 62.5)).norm() < 1e-9);  // back to west
  CHECK(runlines::length_m(lines[4]) == Approx(90.0));
}

TEST_CASE("what makes no survey is refused with its cause") {
  const auto level = [](const Vec2&) { return 20.0; };
  CHECK_THROWS_WITH(adapted_lines({{0, 0}, {1, 1}}, level, {}), "an area has at least 3 corners");
  CHECK_THROWS_WITH(adapted_lines({{0, 0}, {1, 1}, {2, 2}}, level, {}),
                    "the area is empty: its corners lie on one line");
  CHECK_THROWS_WITH(spaced_lines({{0, 0}, {200, 100}, {200, 0}, {0, 300}}, 10.0, {}),
                    Catch::StartsWith("the area crosses itself"));
  CHECK_THROWS_WITH(adapted_lines(kSquare, [](const Vec2&) { return NAN; }, {}),
                    Catch::StartsWith("(0.0, 2.5) m lies outside the terrain; allowed: an area whose rectangle"));
  CHECK_THROWS_WITH(adapted_lines(kSquare, [](const Vec2&) { return -1.0; }, {}),
                    Catch::Contains("is -1 m; allowed: above 0"));
  CHECK_THROWS_WITH(spaced_lines(kSquare, 1e-3, {}), "the area would take more than 10000 lines");
}

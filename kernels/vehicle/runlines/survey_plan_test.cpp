#include "kernels/vehicle/runlines/survey_plan.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

using namespace ensonify::runlines;
constexpr double kPi = std::numbers::pi;
constexpr float kHole = std::numeric_limits<float>::quiet_NaN();

namespace {

/// 101 x 61 posts 10 m apart about the origin: 1010 m east, 610 m north.
struct Ground {
  std::vector<float> height_m;
  HeightGrid grid{-500, -300, 10, 101, 61, {}};

  explicit Ground(const std::function<double(double, double)>& height) {
    for (int row = 0; row < 61; ++row) {
      for (int column = 0; column < 101; ++column) {
        height_m.push_back(static_cast<float>(height(-500 + 10 * column, -300 + 10 * row)));
      }
    }
    grid.height_m = height_m;
  }
};

SurveyRequest request_of(int lines, double longest_m) {
  SurveyRequest request;
  request.most_lines = lines;
  request.longest_line_m = longest_m;
  request.swath_rad = kPi / 2;  // as wide as twice the depth
  request.overlap = 0.25;
  return request;
}

/// Every swath of the plan lies over known ground.
void check_covered(const HeightGrid& ground, const SurveyPlan& plan, double swath_rad) {
  for (const Runline& line : plan.lines) {
    const Vec2 forward = (line.end_enu_m - line.start_enu_m).normalized();
    const Vec2 starboard(forward.y(), -forward.x());
    for (double along = 0.0; along <= length_m(line); along += 5.0) {
      const Vec2 under = point_on(line, along);
      const double half_m = -ground.nearest_height_m(under) * std::tan(0.5 * swath_rad);
      for (double across = -half_m; across <= half_m; across += 5.0) {
        REQUIRE_FALSE(std::isnan(ground.nearest_height_m(under + across * starboard)));
      }
    }
  }
}

}  // namespace

TEST_CASE("over a whole flat chart the lines lie in its middle, spaced by swath and overlap") {
  const Ground ground([](double, double) { return -20.0; });
  const auto plan = plan_survey(ground.grid, request_of(5, 400));
  REQUIRE(plan.lines.size() == 5);
  CHECK(plan.spacing_m == Approx(2 * 20 * 0.75));
  CHECK((point_on(plan.lines[2], 200)).norm() < 1e-6);
  for (const auto& line : plan.lines) CHECK(length_m(line) == Approx(400));
}

TEST_CASE("lines run along the longer side when it matters") {
  const Ground ground([](double, double) { return -20.0; });
  const auto plan = plan_survey(ground.grid, request_of(2, 5000));
  CHECK(std::abs(std::sin(heading_rad(plan.lines[0]))) == Approx(1.0));  // east or west
  CHECK(length_m(plan.lines[0]) == Approx(1010));
}

TEST_CASE("a hole in the middle pushes the survey into the larger side") {
  const Ground ground([](double x, double y) { return std::hypot(x - 100, y) < 60 ? kHole : -15.0; });
  auto request = request_of(6, 300);
  request.heading_rad = 0.0;
  const auto plan = plan_survey(ground.grid, request);
  CHECK(plan.lines.size() == 6);
  for (const auto& line : plan.lines) CHECK(line.start_enu_m.x() < 40);
  check_covered(ground.grid, plan, request.swath_rad);
}

TEST_CASE("swaths stay over known ground at any heading, on a slope, in an odd-shaped chart") {
  const Ground ground(
      [](double x, double y) { return x * x / 250000 + y * y / 62500 < 1.0 ? -20.0 - 0.02 * x : kHole; });
  for (const double heading : {0.0, 0.4, 1.1, 2.5}) {
    auto request = request_of(4, 250);
    request.heading_rad = heading;
    const auto plan = plan_survey(ground.grid, request);
    CHECK(plan.lines.size() >= 2);
    CHECK(std::abs(std::sin(heading_rad(plan.lines[0]) - heading)) < 1e-9);
    check_covered(ground.grid, plan, request.swath_rad);
  }
}

TEST_CASE("turn room is given up before the survey is, run-in never") {
  const Ground ground([](double x, double) { return std::abs(x) <= 200 ? -20.0 : kHole; });
  auto request = request_of(1, 1000);
  request.heading_rad = kPi / 2;  // 410 m from edge to edge
  request.run_in_m = 30;
  request.turn_room_m = 80;
  CHECK(length_m(plan_survey(ground.grid, request).lines.at(0)) == Approx(410 - 160));
  request.turn_room_m = 200;
  CHECK(length_m(plan_survey(ground.grid, request).lines.at(0)) == Approx(410 - 60));
}

TEST_CASE("land and shoals count as holes; too little space states available and needed") {
  const Ground land([](double, double) { return 3.0; });
  CHECK_THROWS_WITH(plan_survey(land.grid, request_of(1, 100)),
                    "no part of the chart is known and more than 2 m below the head");
  const Ground pool([](double x, double y) { return std::abs(x) < 45 && std::abs(y) < 15 ? -30.0 : kHole; });
  auto request = request_of(1, 100);
  request.heading_rad = kPi / 2;
  CHECK_THROWS_WITH(
      plan_survey(pool.grid, request),
      "the largest area without holes is 90 m x 30 m; one line needs 20 m x 60 m (swath at 30 m below the head)");
}

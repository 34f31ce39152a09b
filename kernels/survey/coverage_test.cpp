#include "kernels/survey/coverage.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace ensonify;
using namespace ensonify::survey;
using Catch::WithinAbs;

namespace {

/// A vessel with a fan of 121 beams over 60 degrees either side, on a plane that deepens to the east: x_m from the
/// western edge. Two pings a cell.
void survey_line(Coverage& coverage, const Runline& line, double deepening, double cell_m) {
  const double length_m = runlines::length_m(line);
  const Vec2 forward = (line.end_enu_m - line.start_enu_m) / length_m;
  const auto depth = [&](double east_m) { return 10.0 + deepening * east_m; };
  for (double along = 0.25 * cell_m; along < length_m; along += 0.5 * cell_m) {
    const Vec2 at = line.start_enu_m + along * forward;
    for (int beam = -60; beam <= 60; ++beam) {
      const double tangent = std::tan(beam * 3.14159265358979 / 180.0);
      const double x = depth(at.x()) * tangent / (1.0 - deepening * tangent);
      coverage.add({at.x() + x, at.y()}, -depth(at.x() + x));
    }
  }
  coverage.end_line();
}

}  // namespace

TEST_CASE("a cell is covered from the sounding on that it needs") {
  Coverage coverage({{50, 50}, 0.0, 100.0, 100.0}, 10.0, 3);
  CHECK(coverage.columns() == 10);
  CHECK((coverage.corner_enu_m() - Vec2(0, 0)).norm() < 1e-9);
  for (int i = 0; i < 3; ++i) {
    CHECK_THAT(coverage.covered(), WithinAbs(0.0, 1e-12));
    coverage.add({15.0, 25.0}, -20.0 - i);
  }
  coverage.add({-1.0, 25.0}, -20.0);
  CHECK(coverage.covered() == Approx(0.01));
  CHECK(coverage.soundings(1, 2) == 3);
  CHECK(coverage.height_m(1, 2) == Approx(-21.0));
  CHECK(std::isnan(coverage.height_m(0, 0)));
  CHECK(coverage.overlapped() == 0.0);
  coverage.end_line();
  CHECK(coverage.overlapped() == 1.0);
  CHECK(coverage.depths(-1.0).shallowest_m == Approx(20.0));
  CHECK(coverage.depths(-1.0).deepest_m == Approx(20.0));
}

TEST_CASE("the next line lies a reach beyond the row that is covered least far") {
  Coverage coverage({{50, 10}, 0.0, 20.0, 100.0}, 10.0, 1);  // two rows
  CHECK(coverage.open_rows(0.0, 0.0).empty());               // nothing is known yet
  for (double x = 5.0; x < 60.0; x += 10.0) coverage.add({x, 5.0}, -20.0);
  for (double x = 5.0; x < 40.0; x += 10.0) coverage.add({x, 15.0}, -25.0);
  const auto open = coverage.open_rows(15.0, -1.0);
  REQUIRE(open.size() == 2);
  CHECK(open[0].across_m == 60.0);
  CHECK(open[0].depth_m == 19.0);
  CHECK(open[1].across_m == 40.0);
  CHECK(open[1].depth_m == 24.0);
  CHECK(coverage.depths(-1.0).shallowest_m == 19.0);
  CHECK(coverage.depths(-1.0).deepest_m == 24.0);
}

TEST_CASE("lines over holes are run once") {
  Coverage coverage({{50, 10}, 0.0, 20.0, 100.0}, 10.0, 1);
  for (double x = 5.0; x < 100.0; x += 10.0) {
    if (x != 35.0) coverage.add({x, 5.0}, -20.0);
    if (x != 35.0 && x != 85.0) coverage.add({x, 15.0}, -20.0);
  }
  CHECK(coverage.holes() == 3);
  CHECK(coverage.take_holes(15.0) == 35.0);
  CHECK(coverage.take_holes(15.0) == 85.0);
  CHECK(std::isnan(coverage.take_holes(15.0)));
}

TEST_CASE("a plane of 10-40 m is covered without a gap, lines within 15 % of the bound") {
  const double deepening = 0.02, width_m = 30.0 / deepening, cell_m = 4.0;
  const Rectangle area{{0.5 * width_m, 50.0}, 0.0, 100.0, width_m};
  Coverage coverage(area, cell_m, 1);
  const Swath swath{std::acos(0.5), 0.05};
  double across_m = 15.0;
  int lines = 0;
  for (bool done = false; !done && lines < 100; ++lines) {
    survey_line(coverage, line_across(area, across_m, lines % 2 == 1), deepening, cell_m);
    const auto open = coverage.open_rows(across_m, 0.0);
    done = open.empty();
    if (!done) across_m = next_line_across_m(open, swath, width_m);
  }
  const double fixed = std::ceil(width_m / ((2.0 - swath.overlap) * 10.0 * std::tan(swath.half_angle_rad)));
  CAPTURE(lines, fixed);
  CHECK(coverage.holes() == 0);
  CHECK(lines < 1.15 * adaptive_share(10.0, 40.0) * fixed);
}

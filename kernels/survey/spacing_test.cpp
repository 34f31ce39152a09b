#include "kernels/survey/spacing.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace ensonify::survey;
using Catch::WithinAbs;

namespace {

/// Lines over a plane from `shallow_m` to `deep_m` that deepens by `deepening` per metre, the first one's near half
/// swath on the shallow edge, until the deep edge is covered.
std::vector<double> lines(double shallow_m, double deep_m, double deepening, const Swath& swath) {
  const double width_m = (deep_m - shallow_m) / deepening;
  std::vector<double> across_m;
  for (CoveredEdge edge{0.0, shallow_m}; edge.across_m < width_m;) {
    const CoveredEdge rows[] = {edge};
    across_m.push_back(next_line_across_m(rows, swath, width_m));
    const double here_m = shallow_m + deepening * across_m.back();
    edge.across_m = across_m.back() + reach_m(here_m, deepening, swath.half_angle_rad);
    edge.depth_m = shallow_m + deepening * edge.across_m;
  }
  return across_m;
}

}  // namespace

TEST_CASE("a swath of 120 degrees reaches 1.73 depths on level ground, more downslope") {
  const double sixty = std::acos(0.5);
  CHECK(reach_m(20.0, 0.0, sixty) == Approx(20.0 * std::sqrt(3.0)));
  // The outermost beam hits the slope where the depth below the head is reach / tan(angle).
  for (const double deepening : {-0.3, 0.1, 0.5}) {
    const double x = reach_m(20.0, deepening, sixty);
    CHECK(20.0 + deepening * x == Approx(x / std::sqrt(3.0)));
  }
  CHECK(std::isinf(reach_m(20.0, 0.6, sixty)));
}

TEST_CASE("the row that reaches least decides where the next line goes") {
  const CoveredEdge rows[] = {{100.0, 20.0}, {95.0, 21.0}, {104.0, 19.0}};
  CHECK(next_line_across_m(rows, {std::atan(2.0), 0.1}, 1e3) == Approx(95.0 + 0.9 * 2.0 * 21.0));
  CHECK(next_line_across_m(rows, {std::atan(2.0), 0.1}, 115.0) == 105.0);  // half way from 95 m to the end
  CHECK_THROWS_AS(next_line_across_m({}, {}, 1e3), std::invalid_argument);
}

TEST_CASE("on a slope the distances between lines grow as (1 + g t) / (1 - g t)") {
  const double t = std::tan(1.0), g = 0.05;
  const auto across_m = lines(10.0, 60.0, g, {1.0, 0.0});
  REQUIRE(across_m.size() > 5);
  for (std::size_t i = 2; i + 1 < across_m.size(); ++i) {  // the last lies in what is left
    CHECK((across_m[i] - across_m[i - 1]) / (across_m[i - 1] - across_m[i - 2]) ==
          Approx((1.0 + g * t) / (1.0 - g * t)));
  }
}

TEST_CASE("adaptive lines over fixed ones tend to d1 ln(d2 / d1) / (d2 - d1)") {
  CHECK(adaptive_share(10.0, 40.0) == Approx(10.0 * std::log(4.0) / 30.0));
  CHECK(adaptive_share(20.0, 20.0) == 1.0);
  const Swath swath{std::acos(0.5), 0.0};
  for (const double slope : {0.002, 0.0005}) {
    const double fixed = (40.0 - 10.0) / slope / (2.0 * 10.0 * std::sqrt(3.0));
    const double share = static_cast<double>(lines(10.0, 40.0, slope, swath).size()) / fixed;
    // Off by at most one line and by (g t)^2, 1e-5.
    CHECK_THAT(share, WithinAbs(adaptive_share(10.0, 40.0), 1.0 / fixed + 1e-5));
  }
}

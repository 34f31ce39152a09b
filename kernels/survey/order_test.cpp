#include <catch2/catch.hpp>

#include "kernels/survey/coverage.h"

using namespace ensonify::survey;

TEST_CASE("the orders allow what S-44 prints") {
  // Table 1: Special Order a 0.25 m, b 0.0075, THU 2 m; Order 1a a 0.5 m, b 0.013, THU 5 m + 5 % of the depth.
  const double special_40_m = 0.3905, order_1a_100_m = 1.3928;  // sqrt(0.25^2 + 0.3^2), sqrt(0.5^2 + 1.3^2)
  CHECK(meets(kSpecialOrder, 40.0, special_40_m - 1e-4, 2.0));
  CHECK_FALSE(meets(kSpecialOrder, 40.0, special_40_m + 1e-4, 2.0));
  CHECK_FALSE(meets(kSpecialOrder, 40.0, 0.1, 2.01));
  CHECK(meets(kOrder1a, 100.0, order_1a_100_m - 1e-4, 10.0));
  CHECK_FALSE(meets(kOrder1a, 100.0, order_1a_100_m + 1e-4, 10.0));
  CHECK_FALSE(meets(kOrder1a, 100.0, 0.1, 10.01));
  // Cubic features above 1 m; above 2 m down to 40 m and a tenth of the depth beyond.
  CHECK(cube_m(kSpecialOrder, 100.0) == 1.0);
  CHECK(cube_m(kOrder1a, 40.0) == 2.0);
  CHECK(cube_m(kOrder1a, 100.0) == Approx(10.0));
}

#include <catch2/catch.hpp>
#include <string>

#include "kernels/survey/lines.h"

using namespace ensonify::survey;

TEST_CASE("the area of a polygon, either sense, concave too") {
  CHECK(area_m2({{0, 0}, {400, 0}, {400, 200}, {0, 200}}) == Approx(80000.0));
  CHECK(area_m2({{0, 0}, {0, 2}, {2, 2}, {2, 0}, {1, 1}}) == Approx(3.0));
}

TEST_CASE("an area that crosses or touches itself is refused, however large it is by signs") {
  const auto crosses = [](const Polygon& area, const std::string& sides) {
    CHECK_THROWS_WITH(check_simple(area), Catch::StartsWith("the area crosses itself: the side from corner " + sides));
  };
  crosses({{0, 0}, {200, 100}, {200, 0}, {0, 300}},
          "1 (0, 0) crosses the one from corner 3 (200, 0)");  // one lobe larger
  crosses({{0, 0}, {200, 100}, {200, 0}, {0, 100}}, "1 (0, 0) crosses the one from corner 3 (200, 0)");  // both alike
  crosses({{0, 0}, {50, 50}, {100, 100}, {100, 0}, {50, 50}, {0, 100}}, "1");  // through a corner
  crosses({{0, 0}, {100, 0}, {100, 100}, {50, 0}, {0, 100}}, "1");             // a corner on a side
  crosses({{0, 0}, {100, 0}, {50, 0}, {50, 80}}, "1");                         // back along its own side
  crosses({{0, 0}, {90, 0}, {90, 90}, {0, 0}, {-90, 0}, {-90, -90}}, "");      // two triangles on one corner
  CHECK_NOTHROW(check_simple({{0, 0}, {0, 100}, {0, 100}, {100, 100}, {100, 0}, {0, 0}}));  // corners given again
  CHECK_NOTHROW(check_simple({{0, 0}, {50, 0}, {100, 0}, {100, 100}}));                     // a corner along a side
  CHECK_NOTHROW(check_simple({{0, 0}, {90, 0}, {90, 100}, {60, 100}, {60, 40}, {30, 40}, {30, 100}, {0, 100}}));
}

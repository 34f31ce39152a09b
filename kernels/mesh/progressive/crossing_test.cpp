#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/mesh/progressive/hierarchy.h"
#include "kernels/mesh/progressive/objects.h"
#include "kernels/mesh/progressive/testing/meshes.h"

using namespace ensonify;
using namespace ensonify::progressive;
using Catch::WithinAbs;

namespace {

/// A slope that rises to the north by half a metre a metre: z = y / 2 - 10, 40 x 40 m about (100, 0).
TriangleMesh slope() {
  auto mesh =
      sheet(9, 9, [](int i, int j) { return Eigen::Vector3f(5.0F * i - 20.0F, 5.0F * j - 20.0F, 2.5F * j - 10.0F); });
  mesh.origin_enu_m = {100.0, 0.0, -10.0};
  return mesh;
}

}  // namespace

TEST_CASE("a track crosses a slope where its height is reached, and nothing below that") {
  // z = -20 at y = -20 and 0 at y = 20; the way runs north from y = -50 along x = 101.3. The answer is slack wide: at
  // this slope 2 kSlack_m, and floats.
  const auto crossing = [](double z_m) { return first_crossing_m(slope(), {{101.3, -50.0}, {101.3, 50.0}, z_m}); };
  REQUIRE(crossing(-8.0));
  CHECK_THAT(*crossing(-8.0), WithinAbs(50.0 + 2.0 * (-8.0 + 10.0), 2.0 * kSlack_m + 1e-5));
  REQUIRE(crossing(-15.0));
  CHECK_THAT(*crossing(-15.0), WithinAbs(50.0 - 10.0, 2.0 * kSlack_m + 1e-5));
  CHECK_THAT(*crossing(-30.0), WithinAbs(30.0, 1e-5));  // its edge
  CHECK_FALSE(crossing(0.1));
  // The other way round it is above all of it at once, from its upper edge on; half a way ends before it.
  CHECK_THAT(*first_crossing_m(slope(), {{101.3, 50.0}, {101.3, -50.0}, -8.0}), WithinAbs(30.0, 1e-5));
  CHECK_FALSE(first_crossing_m(slope(), {{101.3, -50.0}, {101.3, -10.0}, -8.0}));
  CHECK_FALSE(first_crossing_m(slope(), {{121.0, -50.0}, {121.0, 50.0}, -30.0}));  // beside it
}

TEST_CASE("a crossing of a wall is found anywhere between its foot and its top") {
  const SheetPileWall wall{.from_enu_m = {-30.0, 20.0}, .to_enu_m = {30.0, 20.0}, .foot_depth_m = 12.0};
  const TriangleMesh mesh = mesh_of(wall, {1, "wall"});
  // The section is half its depth to either side, and the piles stand 15 mm out of line: four deviations.
  const double off_m = 0.5 * wall.profile_depth_m + 0.06;
  for (int i = -100; i <= 100; ++i) {
    const double x = 0.29 * i;
    for (const double z_m : {0.0, -5.0, -40.0}) {  // its top; and what stands higher than a way is in it too
      const auto crossing = first_crossing_m(mesh, {{x, -80.0}, {x, 80.0}, z_m});
      REQUIRE(crossing);
      CHECK(std::abs(*crossing - 100.0) < off_m);
    }
    CHECK_FALSE(first_crossing_m(mesh, {{x, -80.0}, {x, 80.0}, 0.01}));
    CHECK_FALSE(first_crossing_m(mesh, {{x, -80.0}, {x, 19.0}, 0.0}));
  }
  // Along it, half a metre off; round its end; and no way at all.
  CHECK_FALSE(first_crossing_m(mesh, {{-80.0, 19.5}, {80.0, 19.5}, 0.0}));
  CHECK_FALSE(first_crossing_m(mesh, {{31.0, -80.0}, {31.0, 80.0}, 0.0}));
  CHECK_FALSE(first_crossing_m(mesh, {{0.0, 20.0}, {0.0, 20.0}, 0.0}));
}

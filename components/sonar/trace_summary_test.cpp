#include <catch2/catch.hpp>

#include "components/sonar/sea_acoustics.h"

using namespace ensonify;
using Catch::WithinAbs;

TEST_CASE("a black image has a reason, in words") {
  CHECK(no_echo_reason({.rays_that_hit = 9, .rays_in_lobe = 1, .range_m = 20.0, .altitude_m = 5.0}).empty());
  CHECK(no_echo_reason({.range_m = 20.0, .altitude_m = 25.0}) == "the range of 20.0 m is below the altitude of 25.0 m");
  CHECK(no_echo_reason({.range_m = 20.0}) ==
        "nothing within the range of 20.0 m, and no seabed below the head: the terrain has a hole");
  CHECK(
      no_echo_reason({.rays_that_hit = 7, .range_m = 20.0, .altitude_m = 5.0}) ==
      "nothing within the range of 20.0 m where the head points (side lobes hit something): it points over the seabed "
      "5.0 m below, or is mounted or tilted the wrong way");
}

TEST_CASE("the altitude is measured straight down, however the head is turned") {
  trace::Scene scene({0, 0});
  scene.insert({0, 0}, terrain::sample_tile({.origin_enu_m = {-8, -8}, .spacing_m = 0.5, .cells = 32}, {0, 0},
                                            [](double, double) { return -30.0; }));
  const frames::HeadPose head{{1.0, 2.0, -10.0}, frames::enu_from_body({0.7, 0.4, -0.3})};
  REQUIRE(altitude_m(scene, head));
  CHECK_THAT(*altitude_m(scene, head), WithinAbs(20.0, 1e-4));
  CHECK_FALSE(altitude_m(scene, {{100.0, 0.0, -10.0}, head.enu_from_head}));
}

#include <catch2/catch.hpp>

#include "components/terrain_pager/paging.h"

using ensonify::pager::demanded_m;

TEST_CASE("the farthest reach of all heads is demanded") {
  CHECK(demanded_m({{"side/reach_m", "151.5"}, {"sounder/reach_m", "100"}, {"seed", "7"}}, 40.0) == 151.5);
}

TEST_CASE("a head that follows the depth demands 71 degrees from nadir, within its range") {
  CHECK(demanded_m({{"bow/reach_m", "200"}, {"bow/auto_range", "1"}}, 20.0) == 80.0);
  CHECK(demanded_m({{"bow/reach_m", "200"}, {"bow/auto_range", "1"}}, 100.0) == 200.0);
}

TEST_CASE("Doppler logs and altimeters demand tiles below them, whatever the heads' ranges") {
  CHECK(demanded_m({{"look/reach_m", "50"}}, 100.0) == 120.0);
}

TEST_CASE("without any head there is what the depth asks for") { CHECK(demanded_m({{"seed", "7"}}, 20.0) == 80.0); }

#include <catch2/catch.hpp>

#include "components/terrain_pager/paging.h"

using namespace ensonify;
using pager::demanded_m;

namespace {

msg::HeadDeclaration reaching(double reach_m, bool auto_range = false) {
  msg::HeadDeclaration head;
  head.reach_m = reach_m;
  head.auto_range = auto_range;
  return head;
}

}  // namespace

TEST_CASE("the farthest reach of all heads is demanded") {
  CHECK(demanded_m({{"side", reaching(151.5)}, {"sounder", reaching(100.0)}}, 40.0) == 151.5);
}

TEST_CASE("a head that follows the depth demands 71 degrees from nadir, within its range") {
  CHECK(demanded_m({{"bow", reaching(200.0, true)}}, 20.0) == 80.0);
  CHECK(demanded_m({{"bow", reaching(200.0, true)}}, 100.0) == 200.0);
}

TEST_CASE("Doppler logs and altimeters demand tiles below them, whatever the heads' ranges") {
  CHECK(demanded_m({{"look", reaching(50.0)}}, 100.0) == 120.0);
}

TEST_CASE("without any head there is what the depth asks for") {
  CHECK(demanded_m({}, 20.0) == 80.0);
  CHECK(demanded_m({{"mute", {}}}, 20.0) == 80.0);  // one without a range
}

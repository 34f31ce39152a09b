#include "components/sonar/silence.h"

#include <catch2/catch.hpp>

using namespace ensonify;

TEST_CASE("a spell without pings is news when it begins and when its cause changes, not beat by beat") {
  Silence silence;
  CHECK_FALSE(silence.end());
  CHECK(silence.pass_over(1_s, "the head is 0.04 m above the water"));
  CHECK_FALSE(silence.pass_over(2_s, "the head is 1.27 m above the water"));
  CHECK(silence.pass_over(3_s, "no seabed tile under the head at (-3, 4) m"));
  CHECK_FALSE(silence.pass_over(4_s, "no seabed tile under the head at (3, 4) m"));
  const auto spell = silence.end();
  REQUIRE(spell);
  CHECK(spell->since == 1_s);
  CHECK(spell->passed_over == 4);
  CHECK_FALSE(silence.end());
  CHECK(silence.pass_over(9_s, "no seabed tile under the head at (3, 4) m"));  // a new spell
}

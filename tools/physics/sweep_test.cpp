#include "tools/physics/sweep.h"

#include <catch2/catch.hpp>
#include <string>

#include "tools/physics/verb.h"

using ensonify::physics::sweep;

TEST_CASE("a number is one value, a sweep goes as far as its step reaches, up or down") {
  CHECK(sweep("-2.5", -5, 5) == std::vector{-2.5});
  CHECK(sweep("0:10:4", 0, 10) == std::vector<double>{0, 4, 8});
  CHECK(sweep("10:0:-5", 0, 10) == std::vector<double>{10, 5, 0});
  CHECK(sweep("7:7:1", 0, 10) == std::vector<double>{7});
  const auto tenths = sweep("0:0.3:0.1", 0, 0.3);  // 3 * 0.1 is a little above 0.3
  REQUIRE(tenths.size() == 4);
  CHECK(tenths.back() == 0.3);
}

TEST_CASE("what is no sweep is refused with its cause") {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      sweep(text, 0, 10);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  for (const std::string text : {"", "warm", "1m", "1:", "1::2", "1:2:x", " 1"}) {
    CHECK(refusal(text) == "'" + text + "' is neither a number nor a sweep from:to:step");
  }
  CHECK(refusal("1:2") == "'1:2' has 2 numbers; a sweep is from:to:step");
  CHECK(refusal("1:2:1:1") == "'1:2:1:1' has 4 numbers; a sweep is from:to:step");
  CHECK(refusal("11") == "11 is outside [0, 10]");
  CHECK(refusal("0:11:1") == "11 is outside [0, 10]");
  CHECK(refusal("nan") == "nan is outside [0, 10]");
  CHECK(refusal("0:5:-1") == "a step of -1 never goes from 0 to 5");
  CHECK(refusal("0:5:0") == "'0:5:0' has more than 1000000 values");
  CHECK(refusal("5:5:0") == "a step of 0 never goes from 5 to 5");
  CHECK(refusal("0:10:1e-6") == "'0:10:1e-6' has more than 1000000 values");
}

#include "components/feeds/lines.h"

#include <catch2/catch.hpp>
#include <vector>

using namespace ensonify;

namespace {

struct Taken {
  Lines lines;
  std::vector<std::string> found;
  int too_long = 0;

  void take(std::string_view bytes, bool begins = false, bool whole = false) {
    lines.take(
        bytes, begins, whole, [&](std::string_view line) { found.emplace_back(line); }, [&] { ++too_long; });
  }
};

}  // namespace

TEST_CASE("a line that comes in pieces is one line") {
  Taken taken;
  taken.take("$IIH");
  taken.take("SC,1\r\n\r\n \n$IIHSC,2\n$");
  CHECK(taken.found == std::vector<std::string>{"$IIHSC,1\r", "$IIHSC,2"});
}

TEST_CASE("half a line of one connection is not continued by the next") {
  Taken taken;
  taken.take("$IIH");
  taken.take("SC,1\n$IIHSC,2\n", true);
  CHECK(taken.found == std::vector<std::string>{"SC,1", "$IIHSC,2"});
}

TEST_CASE("the last line of a datagram needs no end") {
  Taken taken;
  taken.take("$A\n$B", false, true);
  taken.take("$C", false, true);
  CHECK(taken.found == std::vector<std::string>{"$A", "$B", "$C"});
}

TEST_CASE("a line beyond the longest is counted, and the next one is whole") {
  Taken taken;
  taken.take(std::string(Lines::kLongest + 1, 'x') + "\n" + std::string(Lines::kLongest, 'y') + "\n");
  CHECK(taken.too_long == 1);
  CHECK(taken.found == std::vector<std::string>{std::string(Lines::kLongest, 'y')});
}

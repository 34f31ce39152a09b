#include "components/nav_out/pace.h"

#include <catch2/catch.hpp>
#include <vector>

#include "components/nav_out/turning.h"

using namespace ensonify;
using nav_out::Pace;

namespace {

/// Of ten seconds of an instrument, which measurements leave; each is `off_ns(n)` from its time.
template <class Off>
std::vector<int> taken(double hz, int instrument_hz, std::int64_t start_unix_ns, const Off& off_ns) {
  Pace pace(hz, instrument_hz, start_unix_ns);
  std::vector<int> taken;
  for (int n = 0; n < 10 * instrument_hz; ++n) {
    if (pace.take(n * (1'000'000'000LL / instrument_hz) + off_ns(n))) taken.push_back(n);
  }
  return taken;
}
const auto kExact = [](int) { return 0; };

}  // namespace

TEST_CASE("an instrument's own rate takes each measurement once, however its clock jitters") {
  const auto jitter = [](int n) { return n % 3 == 0 ? -4'000'000 : n % 3 == 1 ? 4'000'000 : 0; };
  CHECK(taken(100.0, 100, 0, kExact).size() == 1000);
  CHECK(taken(100.0, 100, 0, jitter).size() == 1000);
}

TEST_CASE("a lower rate takes those at its instants, of whole seconds of UTC") {
  const auto once_a_second = taken(1.0, 10, 300'000'000, kExact);  // sim time 0 is 0.3 s into a second
  REQUIRE(once_a_second.size() == 11);
  CHECK(once_a_second[1] == 7);
  CHECK(once_a_second[2] == 17);
  CHECK(taken(0.5, 10, 0, kExact) == std::vector<int>{0, 20, 40, 60, 80});
}

TEST_CASE("a rate that does not divide the instrument's is kept on average") {
  const auto found = taken(7.0, 100, 0, kExact);
  CHECK(found.size() == 70);
  for (std::size_t i = 1; i < found.size(); ++i)
    CHECK((found[i] - found[i - 1] == 14 || found[i] - found[i - 1] == 15));
}

TEST_CASE("a rate of turn is the change of headings over a second, through north too") {
  nav_out::Turning turning;
  CHECK_FALSE(turning.rate_radps());
  for (int n = 0; n <= 200; ++n) turning.take(n * 10'000'000LL, frames::wrap_two_pi(-0.05 + 0.05 * 0.01 * n));
  CHECK(*turning.rate_radps() == Approx(0.05));
}

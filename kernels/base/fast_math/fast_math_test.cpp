#include "kernels/base/fast_math/fast_math.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

using namespace ensonify;

TEST_CASE("2^x is right to 2e-7 over all exponents of a float") {
  double worst = 0.0;
  for (int i = 0; i <= 2'530'000; ++i) {
    const auto x = static_cast<float>(-126.0 + 1e-4 * i);
    const double want = std::exp2(static_cast<double>(x));
    worst = std::max(worst, std::abs(static_cast<double>(fast_math::exp2(x)) - want) / want);
  }
  CHECK(worst < 2e-7);
}

TEST_CASE("2^x of whole numbers is exact and holds its ends") {
  for (int n = -126; n <= 127; ++n) CHECK(fast_math::exp2(static_cast<float>(n)) == std::ldexp(1.0F, n));
  CHECK(fast_math::exp2(-1e30F) == std::ldexp(1.0F, -126));
  CHECK(fast_math::exp2(1e30F) == std::ldexp(1.0F, 127));
  CHECK(fast_math::exp2(-std::numeric_limits<float>::infinity()) == std::ldexp(1.0F, -126));
}

TEST_CASE("cosine and sine of turns are right to 2e-7") {
  double worst = 0.0;
  for (int i = -1'000'000; i <= 1'000'000; ++i) {
    const auto turns = static_cast<float>(5e-7 * i);
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(turns);
    const auto [cosine, sine] = fast_math::direction(turns);
    worst = std::max(worst, std::abs(static_cast<double>(cosine) - std::cos(angle)));
    worst = std::max(worst, std::abs(static_cast<double>(sine) - std::sin(angle)));
  }
  CHECK(worst < 2e-7);
}

TEST_CASE("cosine and sine of any part of a turn are right to 2e-7") {
  double worst = 0.0;
  for (std::uint64_t turn = 0; turn < (std::uint64_t{1} << 32); turn += 4'001) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(turn) * 0x1p-32;
    const auto [cosine, sine] = fast_math::direction_of(static_cast<std::uint32_t>(turn));
    worst = std::max(worst, std::abs(static_cast<double>(cosine) - std::cos(angle)));
    worst = std::max(worst, std::abs(static_cast<double>(sine) - std::sin(angle)));
  }
  CHECK(worst < 2e-7);
}

TEST_CASE("an angle in turns is right to 6e-8 of a turn, at any length") {
  double worst = 0.0;
  for (const double length : {1e-20, 1.0, 3e36}) {
    for (int i = -500'000; i <= 500'000; ++i) {
      const double angle = 2e-6 * std::numbers::pi * i;
      const auto x = static_cast<float>(length * std::cos(angle)), y = static_cast<float>(length * std::sin(angle));
      const double want = std::atan2(static_cast<double>(y), static_cast<double>(x)) / (2.0 * std::numbers::pi);
      worst = std::max(worst, std::abs(std::remainder(static_cast<double>(fast_math::turns_of(x, y)) - want, 1.0)));
    }
  }
  CHECK(worst < 6e-8);
  CHECK(fast_math::turns_of(0.0F, 0.0F) == 0.0F);
  CHECK(fast_math::turns_of(1.0F, 1.0F) == Approx(0.125F));
  CHECK(fast_math::turns_of(-1.0F, 0.0F) == 0.5F);
}

TEST_CASE("a logarithm is right to 2e-7 of it, or 1e-8 where it is small") {
  double worst = 0.0;
  for (float x = std::numeric_limits<float>::min(); x < 1e38F; x *= 1.00013F) {
    const double want = std::log(static_cast<double>(x));
    worst = std::max(worst, std::abs(static_cast<double>(fast_math::log(x)) - want) / std::max(std::abs(want), 0.05));
  }
  CHECK(worst < 2e-7);
}

TEST_CASE("whole cycles leave no part of a turn, however many") {
  for (const double cycles : {0.0, 1.0, 1e4, 1e9, -3e6}) {
    CHECK(fast_math::part_of_turn(cycles) == 0.0F);
    CHECK(fast_math::part_of_turn(cycles + 0.25) == 0.25F);
    CHECK(fast_math::part_of_turn(cycles + 0.75) == -0.25F);
  }
}

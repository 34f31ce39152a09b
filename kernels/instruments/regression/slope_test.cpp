#include "kernels/instruments/regression/slope.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "kernels/base/random/stream.h"

using namespace ensonify;
using Catch::WithinAbs;
using regression::slope_through_zero;

TEST_CASE("an exact proportion has its slope, without error") {
  const std::vector<double> x{1.0, -2.0, 0.5, 4.0}, y{3.0, -6.0, 1.5, 12.0};
  const auto slope = slope_through_zero(x, y, 2);
  REQUIRE(slope);
  CHECK_THAT(slope->value, WithinAbs(3.0, 1e-12));
  CHECK_THAT(slope->standard_error, WithinAbs(0.0, 1e-12));
  CHECK(slope->count == 4);
}

TEST_CASE("slope and standard error are those worked by hand") {
  // sum xx = 14, sum xy = 14.5; x e = 9/140, -48/140, 39/140; their squares sum to 3906/19600.
  const std::vector<double> x{1.0, 2.0, 3.0}, y{1.1, 1.9, 3.2};
  const auto plain = slope_through_zero(x, y, 0), correlated = slope_through_zero(x, y, 1);
  CHECK_THAT(plain->value, WithinAbs(14.5 / 14.0, 1e-12));
  CHECK_THAT(plain->standard_error, WithinAbs(std::sqrt(3906.0 / 19600.0) / 14.0, 1e-12));
  // With Bartlett's weight 1/2 of lag 1 the sum is 3906 + 2 * 1/2 * (9 * -48 + -48 * 39) = 1602 of 19600.
  CHECK_THAT(correlated->standard_error, WithinAbs(std::sqrt(1602.0 / 19600.0) / 14.0, 1e-12));
}

TEST_CASE("too few samples, or an x without motion, have no slope") {
  const std::vector<double> two{1.0, 2.0}, still{0.0, 0.0, 0.0}, y{1.0, 2.0, 3.0};
  CHECK_FALSE(slope_through_zero(two, two, 2));
  CHECK_FALSE(slope_through_zero(still, y, 2));
}

TEST_CASE("about its running mean a straight line is 0, and a swing about it stays") {
  std::vector<double> line, swing;
  for (int i = 0; i < 40; ++i) {
    line.push_back(3.0 + 0.7 * i);
    swing.push_back(line.back() +
                    std::sin(2.0 * 3.14159265358979323846 * i / 9.0));  // the window holds it once: mean 0
  }
  for (const double left : regression::about_running_mean(line, 4)) CHECK_THAT(left, WithinAbs(0.0, 1e-12));
  const auto left = regression::about_running_mean(swing, 4);
  REQUIRE(left.size() == 32);
  for (std::size_t i = 0; i < left.size(); ++i) CHECK_THAT(left[i], WithinAbs(swing[i + 4] - line[i + 4], 1e-12));
  CHECK(regression::about_running_mean(std::vector<double>(8), 4).empty());
}

TEST_CASE("of white noise on a swing the stated error is the scatter of the slopes") {
  // 400 draws of 200 samples. Their scatter has a standard deviation of 3.5 %; the running mean colours the noise, of
  // which a few lags know the greater part. The bounds are 25 %.
  const random::Stream noise(7, "slope_test");
  constexpr std::size_t kDraws = 400, kSamples = 208;
  double squares = 0.0;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    std::vector<double> roll(kSamples), place(kSamples);
    for (std::size_t i = 0; i < kSamples; ++i) {
      roll[i] = std::sin(0.8 * static_cast<double>(i));
      place[i] = 5.0 * roll[i] + 0.3 * static_cast<double>(i) + noise.normal(draw, i);
    }
    const auto slope =
        slope_through_zero(regression::about_running_mean(roll, 4), regression::about_running_mean(place, 4), 4);
    squares += std::pow((slope->value - 5.0) / slope->standard_error, 2);
  }
  CHECK_THAT(std::sqrt(squares / kDraws), WithinAbs(1.0, 0.25));
}

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/physics/sidescan_speckle.h"

using namespace ensonify;
using namespace ensonify::physics;
using namespace ensonify::physics::sidescan_speckle;
using Catch::WithinAbs;

TEST_CASE("speckle is Rayleigh: 40 seeds, and its coefficient of variation") {
  // Kolmogorov and Smirnov at 5 %: of 40 tests 2 fail in the mean, and 6 or fewer do in 98.6 % of all choices of seeds.
  // The coefficient of variation of N = 90,000 Rayleigh amplitudes has a relative standard deviation of about
  // 1 / (2 sqrt(N)) = 0.17 %.
  int rejected = 0;
  double n = 0.0, sum = 0.0, squares = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    auto amplitudes = speckle(head(seed), {0.0, 0.0, -12.0});
    std::sort(amplitudes.begin(), amplitudes.end());
    const double count = static_cast<double>(amplitudes.size());
    double distance = 0.0;
    for (std::size_t i = 0; i < amplitudes.size(); ++i) {
      const double expected = 1.0 - std::exp(-amplitudes[i] * amplitudes[i]);
      distance = std::max({distance, std::abs(static_cast<double>(i) / count - expected),
                           std::abs(static_cast<double>(i + 1) / count - expected)});
      sum += amplitudes[i], squares += amplitudes[i] * amplitudes[i];
    }
    n += count;
    rejected += distance > 1.358 / std::sqrt(count);
  }
  REQUIRE(n >= 70'000);
  INFO(rejected << " of 40 rejected, " << n << " samples");
  CHECK(rejected <= 6);
  const double mean = sum / n;
  CHECK(std::sqrt(squares / n - mean * mean) / mean == Approx(0.5227).epsilon(0.01));
  CHECK(squares / n == Approx(1.0).epsilon(0.02));  // N exponentials: 0.33 %
}

TEST_CASE("a whole sidescan's amplitudes have Rayleigh's coefficient of variation") {
  // Over the root of the mean of all seeds' powers about their range (0.75 m), which the closed form is smooth in: what
  // rays leave of a ping's level counts as speckle. Of 100,000 independent samples it is uncertain by 0.0009.
  constexpr int kSeeds = 50;
  std::vector<std::vector<double>> sides;  // a pulse apart, 15 to 100 m
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const auto ping = sidescan_ping(head(static_cast<std::uint64_t>(seed)), level_sand(), {0.0, 0.0, -12.0});
    const Samples from_nadir = samples_about(ping, 57.5, 42.5);
    for (std::size_t side = 0; side < 2; ++side) {
      auto& row = sides.emplace_back();
      for (std::size_t k = from_nadir.first; k < from_nadir.end; k += kPulse)
        row.push_back(ping.amplitude_upa(side, k));
    }
  }
  constexpr std::size_t kTogether = 10;
  double n = 0.0, sum = 0.0, squares = 0.0;
  for (std::size_t first = 0; first + kTogether <= sides[0].size(); first += kTogether) {
    double power = 0.0;
    for (const auto& row : sides) {
      for (std::size_t k = first; k < first + kTogether; ++k) power += row[k] * row[k];
    }
    power /= static_cast<double>(kTogether * sides.size());
    for (const auto& row : sides) {
      for (std::size_t k = first; k < first + kTogether; ++k) {
        n += 1.0, sum += row[k] / std::sqrt(power), squares += row[k] * row[k] / power;
      }
    }
  }
  REQUIRE(n > 100'000);
  const double mean = sum / n, variation = std::sqrt(squares / n - mean * mean) / mean;
  INFO("variation " << variation << " of " << n);
  CHECK_THAT(variation, WithinAbs(std::sqrt(4.0 / std::numbers::pi - 1.0), 0.006));
}

TEST_CASE("a head at rest receives the same seabed again") {
  const bool again = speckle(head(1), {0.0, 0.0, -12.0}) == speckle(head(1), {0.0, 0.0, -12.0});
  CHECK(again);
}

TEST_CASE("sidescan: pings decorrelate along the track as the two-way pattern says") {
  // Echoes from 15 to 100 m, three seabeds: 6,800 independent samples, so a correlation has a standard deviation of 1.2
  // to 2 %. Places that rays aim at wander a little on the seabed, and cells at the rim of what is received come and
  // go.
  for (const double d_over_l : {0.02, 0.1, 0.25, 0.5, 1.05}) {
    const double reached = correlation_after({0.0, d_over_l * line_m(), 0.0}, 3);
    INFO(reached << " after " << d_over_l << " L, theory " << along_track(d_over_l));
    CHECK_THAT(reached, WithinAbs(along_track(d_over_l), 0.05));
  }
}

TEST_CASE("sidescan: pings decorrelate across the track as pulses overlap") {
  // Across the track by d, starboard comes nearer by d cos(grazing), 0.75 to 0.99 d from 15 m on: 0.97 d in the mean.
  for (const double d_m : {0.01, 0.03}) {
    const double reached = correlation_after({d_m, 0.0, 0.0}, 3);
    INFO(reached << " after " << d_m << " m, theory " << across_track(d_m));
    CHECK_THAT(reached, WithinAbs(across_track(d_m), 0.08));
  }
}

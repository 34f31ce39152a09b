#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "kernels/array/line.h"
#include "tests/physics/mills_cross.h"
#include "tests/physics/sidescan_ping.h"

// Speckle of a sidescan over homogeneous sand, by the head itself: amplitudes over the square root of the mean square
// that the same head gives with speckle off, so that the fall of the level over range does not enter.

using namespace ensonify;
using namespace ensonify::physics;

namespace {

constexpr double kAltitude_m = 10.0;
constexpr std::size_t kPulse = 2;  // samples: echoes of samples so far apart share no seabed

const trace::Scene& level_sand() {
  static const trace::Scene scene = scene_of(256.0, 1.0, [](double, double) { return -12.0 - kAltitude_m; });
  return scene;
}

SidescanConfig head(std::uint64_t seed) {
  SidescanConfig config = sidescan_of(400e3);
  config.world.seed = seed;
  return config;
}

/// Amplitudes of both sides from 15 to 100 m, of mean square 1, a pulse apart.
std::vector<double> speckle(SidescanConfig config, const frames::Vec3& position_enu_m) {
  const auto ping = sidescan_ping(config, level_sand(), position_enu_m);
  config.effects.speckle = false;
  const auto mean = sidescan_ping(config, level_sand(), position_enu_m);
  const Samples from_nadir = samples_about(ping, 57.5, 42.5);
  std::vector<double> amplitudes;
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t k = from_nadir.first; k < from_nadir.end; k += kPulse) {
      amplitudes.push_back(static_cast<double>(ping.amplitude_upa(side, k) / mean.amplitude_upa(side, k)));
    }
  }
  return amplitudes;
}

/// Correlation of the powers of two echoes: |coherence|^2 of Gaussian fields.
double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0, square = 0.0, product = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double p = a[i] * a[i], q = b[i] * b[i];
    sum += 0.5 * (p + q), square += 0.5 * (p * p + q * q), product += p * q;
  }
  const double n = static_cast<double>(a.size()), mean = sum / n;
  return (product / n - mean * mean) / (square / n - mean * mean);
}

}  // namespace

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

TEST_CASE("a head that rests hears the same seabed again, one that moved another") {
  // Lines that send and hear: coherence is a cubic spline that ends at d = L. 2,200 samples: a correlation of nothing
  // has a standard deviation of 2 %. After 0.02 L theory says 0.996; where a resolution cell has fewer rays than
  // scatterers, as at the ranges of a sidescan, a moved head meets other ones of them, and keeps about half of it
  // (docs/physics/echo.md; kernels/echo holds the theory where rays are many).
  const SidescanConfig config = head(1);
  const auto here = speckle(config, {0.0, 0.0, -12.0});
  const bool again = speckle(config, {0.0, 0.0, -12.0}) == here;
  CHECK(again);
  const double length_m = array::length_in_waves_for(config.channels[0].horizontal_beamwidth_rad) * 1500.0 / 400e3;
  const auto after = [&](double moved_m) { return correlation(here, speckle(config, {0.0, moved_m, -12.0})); };
  const double near = after(0.02 * length_m), far = after(1.05 * length_m);
  INFO(near << " after 0.02 L, " << far << " after 1.05 L");
  CHECK(near > 0.3);
  CHECK(std::abs(far) < 0.08);
}

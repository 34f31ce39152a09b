#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/base/random/stream.h"
#include "kernels/seabed/statistics/surface.h"
#include "kernels/seabed/statistics/testing/exact_fbm.h"

using namespace ensonify::relief_statistics;
using Catch::WithinAbs;
using ensonify::random::Stream;

TEST_CASE("Sarle's coefficient: 1/3 for a Gaussian, 5/9 for uniform, 1 for two points") {
  const Stream stream{1, "sarle"};
  std::vector<double> gaussian, uniform, two;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    gaussian.push_back(stream.normal(i));
    uniform.push_back(stream.uniform(i));
    two.push_back(static_cast<double>(i % 2));
  }
  // Kurtosis scatters by sqrt(24 / n) = 0.035: 0.33 by 0.004 (4 sd 0.016), 0.56 by less.
  CHECK_THAT(bimodality(gaussian), WithinAbs(1.0 / 3.0, 0.016));
  CHECK_THAT(bimodality(uniform), WithinAbs(5.0 / 9.0, 0.016));
  CHECK_THAT(bimodality(two), WithinAbs(1.0, 1e-3));
}

TEST_CASE("rank correlation sees order, not size; ties share a rank") {
  const std::vector<double> a{1, 2, 3, 4, 5}, cubes{1, 8, 27, 64, 125}, falling{9, 7, 5, 3, 1};
  CHECK(rank_correlation(a, cubes) == Approx(1.0));
  CHECK(rank_correlation(a, falling) == Approx(-1.0));
  // Ranks 0, 1.5, 1.5, 3 against 0, 1, 2, 3: 4.5 / sqrt(4.5 * 5).
  CHECK(rank_correlation(std::vector<double>{1, 2, 2, 3}, std::vector<double>{1, 2, 3, 4}) ==
        Approx(4.5 / std::sqrt(4.5 * 5.0)));
  CHECK(std::isnan(rank_correlation(std::vector<double>{1, 1}, std::vector<double>{1, 2})));
}

TEST_CASE("percentiles lie between ranks") {
  const std::vector<double> numbers{0, 10, 20};
  CHECK(percentile(numbers, 0.0) == 0.0);
  CHECK(percentile(numbers, 0.25) == Approx(5.0));
  CHECK(percentile(numbers, 1.0) == 20.0);
}

TEST_CASE("a chessboard of two roughnesses has the statistics of its two values") {
  // Every patch holds +-1 (rough) or +-0.1 (smooth) in rows of alternating sign, half of them each.
  Surface surface{180, 180, 0.5, {}};
  for (int row = 0; row < 180; ++row) {
    for (int column = 0; column < 180; ++column) {
      const bool rough = (row / 9 + column / 9) % 2 == 0 && row < 171;  // a few more smooth ones: the median is theirs
      surface.height_m.push_back((row % 9 % 2 == 0 ? 1.0F : -1.0F) * (rough ? 1.0F : 0.1F));
    }
  }
  const Patchiness p = patchiness(surface);
  CHECK(p.patches == 400);
  // 190 of 400 patches rough: sqrt(0.475 + 0.525 * 0.01) over 0.1.
  CHECK(p.rms_over_median == Approx(std::sqrt(0.475 + 0.00525) / 0.1).epsilon(1e-5));
  CHECK(p.p95_over_p5 == Approx(10.0).epsilon(1e-5));
  CHECK(p.bimodality > 0.98);
  CHECK_THAT(p.slope_p95_deg, WithinAbs(0.0, 1e-4));
}

TEST_CASE("patches of a plane have its slope; a level surface has no statistics") {
  Surface surface{90, 90, 0.5, {}};
  for (int row = 0; row < 90; ++row) {
    for (int column = 0; column < 90; ++column)
      surface.height_m.push_back(static_cast<float>(0.05 * column + (row % 2 == 0 ? 0.01 : -0.01)));
  }
  CHECK_THAT(patchiness(surface).slope_p50_deg, WithinAbs(std::atan(0.1) * 180 / 3.14159265358979, 0.01));
  surface.height_m.assign(surface.height_m.size(), -20.0F);
  CHECK(patchiness(surface).patches == 0);
}

TEST_CASE("patches of fractional Brownian relief are alike") {
  const Surface surface = exact_fbm(0.625, 512, Stream{2, "fbm"}, 0);
  const Patchiness p =
      patchiness(surface);  // 3136 patches: their scatter moves these by about 1 %. Others: 1.04, 2.1, 0.35
  CHECK_THAT(p.rms_over_median, WithinAbs(1.04, 0.02));
  CHECK_THAT(p.p95_over_p5, WithinAbs(2.0, 0.2));
  CHECK_THAT(p.bimodality, WithinAbs(0.35, 0.04));
}

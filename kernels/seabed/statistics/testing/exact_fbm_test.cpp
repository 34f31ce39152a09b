#include "kernels/seabed/statistics/testing/exact_fbm.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/seabed/statistics/power_spectrum.h"

using namespace ensonify::relief_statistics;
using Catch::WithinAbs;

TEST_CASE("exact fractional Brownian relief has D(r) = r^2H at every lag", "[long]") {
  const ensonify::random::Stream stream{11, "fbm"};
  const int surfaces = 40, posts = 96;
  for (const double hurst : {0.3, 0.625, 0.9}) {
    for (const int lag : {1, 4, 16, 64}) {
      double mean = 0.0, square = 0.0;
      for (int s = 0; s < surfaces; ++s) {
        const double d = structure_function(exact_fbm(hurst, posts, stream, static_cast<std::uint64_t>(s)), lag, 2.0);
        mean += d / surfaces;
        square += d * d / surfaces;
      }
      INFO("H " << hurst << ", lag " << lag);
      // Between surfaces D scatters by what they scatter: four standard errors of the mean of 40.
      CHECK_THAT(mean, WithinAbs(std::pow(lag, 2 * hurst), 4.0 * std::sqrt((square - mean * mean) / surfaces)));
    }
  }
}

TEST_CASE("exact fractional Brownian relief repeats, and numbers differ") {
  const ensonify::random::Stream stream{11, "fbm"};
  CHECK(exact_fbm(0.5, 20, stream, 3).height_m == exact_fbm(0.5, 20, stream, 3).height_m);
  CHECK(exact_fbm(0.5, 20, stream, 3).height_m != exact_fbm(0.5, 20, stream, 4).height_m);
  CHECK_THROWS_WITH(exact_fbm(0.96, 20, stream, 0), "exact_fbm: hurst is 0.960000, allowed: above 0, at most 0.95");
}

#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/base/random/stream.h"
#include "kernels/seabed/statistics/power_spectrum.h"
#include "kernels/seabed/statistics/testing/exact_fbm.h"

using namespace ensonify::relief_statistics;
using Catch::WithinAbs;

TEST_CASE("a tilted plane has differences of lag times slope") {
  Surface surface{40, 50, 2.0, {}};
  for (int row = 0; row < 50; ++row) {
    for (int column = 0; column < 40; ++column) surface.height_m.push_back(static_cast<float>(0.5 * column));
  }
  // Pairs along rows differ by lag / 2, along columns not at all; 50 (40 - lag) and 40 (50 - lag) of them.
  for (const int lag : {1, 7}) {
    const double rows = 50.0 * (40 - lag), columns = 40.0 * (50 - lag);
    CHECK(structure_function(surface, lag, 2.0) == Approx(0.25 * lag * lag * rows / (rows + columns)));
  }
  CHECK(std::isnan(structure_function(surface, 60, 2.0)));
}

TEST_CASE("fractional Brownian relief scales with one exponent: zeta(q) = q H, K2 = 0") {
  ScalingExponents mean;
  const int surfaces = 10;
  for (int s = 0; s < surfaces; ++s) {
    const auto z =
        scaling_exponents(exact_fbm(0.625, 256, ensonify::random::Stream{5, "fbm"}, static_cast<std::uint64_t>(s)));
    mean.zeta_1 += z.zeta_1 / surfaces;
    mean.zeta_2 += z.zeta_2 / surfaces;
    mean.zeta_3 += z.zeta_3 / surfaces;
  }
  // One surface's exponent scatters by about 0.02; the mean of ten by 0.007.
  CHECK_THAT(mean.zeta_1, WithinAbs(0.625, 0.03));
  CHECK_THAT(mean.zeta_2, WithinAbs(1.25, 0.06));
  CHECK_THAT(mean.zeta_3, WithinAbs(1.875, 0.09));
  CHECK_THAT(mean.k2(), WithinAbs(0.0, 0.01));
}

TEST_CASE("holes are left out, small and level surfaces are refused") {
  Surface surface{40, 40, 1.0, std::vector<float>(1600, 0.0F)};
  CHECK_THROWS_WITH(scaling_exponents(surface), "scaling exponents: the surface is level, or all holes");
  surface.height_m[0] = std::nanf("");
  surface.height_m[5] = 2.0F;
  CHECK(structure_function(surface, 1, 1.0) == Approx(2.0 * 3 / (2 * 39 * 40 - 2)));  // 3 neighbours, 2 pairs lost
  surface.columns = 20;
  surface.rows = 80;
  CHECK_THROWS_WITH(scaling_exponents(surface),
                    "scaling exponents: the surface has 20 x 80 posts, allowed: more than 32 each way");
}

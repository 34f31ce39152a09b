#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernels/base/random/stream.h"
#include "kernels/seabed/statistics/testing/exact_fbm.h"
#include "kernels/survey/grid/defects.h"

using namespace ensonify;
using namespace ensonify::survey_grid;
using Catch::WithinAbs;

TEST_CASE("relief is valid down to Nyquist, a smoothed grid's from where it is smooth") {
  auto surface = relief_statistics::exact_fbm(0.625, 512, random::Stream(2, "fbm"), 0);  // W ~ K^-3.25
  const auto own = band_of(surface);
  REQUIRE(own.octaves.size() == 4);
  CHECK(own.begins_cells == 2.0);
  // Estimates of 225 windows and four bins scatter by 0.02; Hann's window adds up to 0.14, the first octave is aliased.
  CHECK_THAT(own.octaves[1].exponent, WithinAbs(3.25, 0.3));
  remove_shorter_waves(surface, 8.0);
  // Half the power is gone at 8 cells: 2 ln 2 (8 / L)^2 steeper, 2.8 in the octave below and 0.7 in that above.
  const auto smooth = band_of(surface);
  CHECK(smooth.begins_cells == 8.0);
  CHECK_THAT(smooth.octaves[1].exponent - own.octaves[1].exponent, WithinAbs(2.8, 0.6));
}

TEST_CASE("waves of the cutoff length keep half their power; holes and levels stay") {
  const double cells = GENERATE(6.0, 10.0);
  Surface surface{120, 40, 1.0, {}};
  for (int i = 0; i < 120 * 40; ++i)
    surface.height_m.push_back(static_cast<float>(-20.0 + std::cos(2.0 * std::numbers::pi * (i % 120) / cells)));
  const auto before = surface;
  surface.height_m[5] = std::numeric_limits<float>::quiet_NaN();
  remove_shorter_waves(surface, cells);
  CHECK(std::isnan(surface.height_m[5]));
  for (int column = 40; column < 80; ++column)  // sampled and cut at four sigma, a Gaussian is off by 1e-3
    CHECK_THAT(surface.at(column, 20) + 20.0, WithinAbs((before.at(column, 20) + 20.0) / std::sqrt(2.0), 2e-3));
  Surface level{30, 30, 1.0, std::vector<float>(900, -12.5F)};
  remove_shorter_waves(level, 8.0);
  for (const float height_m : level.height_m) REQUIRE(height_m == Approx(-12.5F));
}

TEST_CASE("a grid without a whole window has no octaves; wrong lengths are refused") {
  CHECK(band_of(Surface{40, 40, 1.0, std::vector<float>(1600, -1.0F)}).octaves.empty());
  Surface level{30, 30, 1.0, std::vector<float>(900, -12.5F)};
  CHECK_THROWS_AS(remove_shorter_waves(level, 1.5), std::invalid_argument);
}

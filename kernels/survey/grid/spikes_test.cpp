#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>

#include "kernels/base/random/stream.h"
#include "kernels/seabed/statistics/testing/exact_fbm.h"
#include "kernels/survey/grid/defects.h"

using namespace ensonify;
using namespace ensonify::survey_grid;
using Catch::WithinAbs;

namespace {

Surface made(int posts, const std::function<double(int, int)>& height_m) {
  Surface surface{posts, posts, 1.0, {}};
  for (int row = 0; row < posts; ++row) {
    for (int column = 0; column < posts; ++column)
      surface.height_m.push_back(static_cast<float>(height_m(column, row)));
  }
  return surface;
}

const random::Stream kNoise(3, "spikes_test");

double noise_m(int column, int row) {
  return 0.05 * kNoise.normal(static_cast<std::uint64_t>(column), static_cast<std::uint64_t>(row));
}

}  // namespace

TEST_CASE("seabeds have no spikes: relief, white noise, steps, corners, ridges, a cable") {
  CHECK(spikes_of(relief_statistics::exact_fbm(0.6, 256, random::Stream(1, "fbm"), 0)).empty());
  CHECK(spikes_of(made(200, noise_m)).empty());
  CHECK(spikes_of(made(60, [](int c, int r) { return c > 30 && r > 20 ? 5.0 : 0.0; })).empty());
  CHECK(spikes_of(made(60, [](int c, int r) { return c == r ? 1.0 : 0.0; })).empty());
  CHECK(spikes_of(made(60, [](int c, int r) { return std::abs(c - 30) + std::abs(r - 30) < 2 ? 2.0 : 0.0; })).size() ==
        0);  // five cells: a rock
}

TEST_CASE("spikes are found where they stand, above and below, with their height") {
  auto surface = made(100, [](int c, int r) { return 0.02 * c + noise_m(c, r); });
  const auto at = [&](int c, int r) -> float& { return surface.height_m[static_cast<std::size_t>(r * 100 + c)]; };
  at(40, 20) += 1.0F;
  at(70, 60) -= 2.0F;
  at(0, 99) += 3.0F;  // a corner has three neighbours: too few to judge
  for (int r = 30; r < 40; ++r) at(10, r) = std::numeric_limits<float>::quiet_NaN();
  const auto spikes = spikes_of(surface);
  REQUIRE(spikes.size() == 2);
  CHECK((spikes[0].column == 40 && spikes[0].row == 20));
  CHECK((spikes[1].column == 70 && spikes[1].row == 60));
  // The extreme of eight neighbours of 0.05 m noise lies 0.07 +- 0.03 m to their side; twice the noise of the cell.
  CHECK_THAT(spikes[0].above_m, WithinAbs(0.93, 0.2));
  CHECK_THAT(spikes[1].above_m, WithinAbs(-1.93, 0.2));
}

TEST_CASE("what is lower than asked for is not reported") {
  auto surface = made(50, [](int, int) { return -20.0; });
  surface.height_m[25 * 50 + 25] += 0.3F;
  CHECK(spikes_of(surface, 0.1).size() == 1);
  CHECK(spikes_of(surface, 0.5).empty());
}

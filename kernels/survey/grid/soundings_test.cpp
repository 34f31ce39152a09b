#include "kernels/survey/grid/soundings.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "kernels/base/random/stream.h"

namespace ensonify::survey_grid {
namespace {

using Catch::Matchers::WithinAbs;
constexpr double kNotStated = std::numeric_limits<double>::quiet_NaN();

CellSums sums_of(const std::vector<double>& depths_m, double sd_m = kNotStated) {
  CellSums sums;
  for (const double depth_m : depths_m) sums.add(depth_m, sd_m);
  return sums;
}

}  // namespace

TEST_CASE("a cell gives mean, shoalest, deepest, count and standard deviation of its soundings") {
  const CellSums sums = sums_of({10.0, 11.0, 13.0, 14.0});  // deviations -2, -1, 1, 2: variance 10 / 3
  CHECK(sums.count() == 4);
  CHECK(sums.mean_m() == 12.0);
  CHECK(sums.shoalest_m() == 10.0);
  CHECK(sums.deepest_m() == 14.0);
  CHECK_THAT(sums.sd_m(), WithinAbs(std::sqrt(10.0 / 3.0), 1e-12));
  CHECK(sums.weighted_m() == 12.0);
  CHECK(std::isnan(sums.stated_sd_m()));
}

TEST_CASE("of no soundings nothing is known, and of one no standard deviation") {
  const CellSums none, one = sums_of({7.0});
  CHECK(none.count() == 0);
  for (const double value : {none.mean_m(), none.shoalest_m(), none.sd_m(), none.weighted_m(), none.uncertainty_m()})
    CHECK(std::isnan(value));
  CHECK(one.mean_m() == 7.0);
  CHECK(std::isnan(one.sd_m()));
  CHECK(std::isnan(one.uncertainty_m()));
}

TEST_CASE("stated soundings weigh as one over their variance, others not at all") {
  CellSums sums;
  sums.add(10.0, 0.1);  // weight 100
  sums.add(11.0, 0.2);  // weight 25
  sums.add(99.0, kNotStated);
  CHECK_THAT(sums.weighted_m(), WithinAbs((100.0 * 10.0 + 25.0 * 11.0) / 125.0, 1e-12));
  CHECK_THAT(sums.mean_m(), WithinAbs(40.0, 1e-12));
  CHECK_THAT(sums.stated_sd_m(), WithinAbs(std::sqrt((0.01 + 0.04) / 2.0), 1e-12));
}

TEST_CASE("a cell's uncertainty is the larger of what is stated and what is observed, at 95 %") {
  CHECK_THAT(sums_of({10.0, 10.2}, 0.5).uncertainty_m(), WithinAbs(1.959964 * 0.5, 1e-9));
  CHECK_THAT(sums_of({10.0, 12.0}, 0.5).uncertainty_m(), WithinAbs(1.959964 * std::sqrt(2.0), 1e-9));
}

TEST_CASE("a standard deviation of a millimetre is right at 8 km") {
  const random::Stream noise{7, "cell"};
  CellSums sums;
  for (std::uint64_t i = 0; i < 10'000; ++i) sums.add(8000.0 + 1e-3 * noise.normal(i, 0), kNotStated);
  CHECK_THAT(sums.sd_m(), WithinAbs(1e-3, 3e-5));  // four times sd / sqrt(2 n)
}

TEST_CASE("cells have their edges on multiples of their side, also west and south of the origin") {
  SoundingGrid grid(2.0);
  grid.add(0.0, 0.0, 10.0, kNotStated);  // the south-west corner belongs to a cell, the others do not
  grid.add(1.999, 1.999, 20.0, kNotStated);
  grid.add(-0.001, 0.0, 30.0, kNotStated);
  grid.add(-300.0, -500.0, 40.0, kNotStated);
  grid.add(kNotStated, 0.0, 1.0, kNotStated);
  grid.add(0.0, 0.0, kNotStated, kNotStated);
  CHECK(grid.soundings() == 4);
  CHECK(grid.at(0, 0).count() == 2);
  CHECK(grid.at(0, 0).mean_m() == 15.0);
  CHECK(grid.at(-1, 0).mean_m() == 30.0);
  CHECK(grid.at(-150, -250).mean_m() == 40.0);
  CHECK(grid.at(5, 5).count() == 0);
  const SoundingGrid::Frame frame = grid.frame();
  CHECK(frame.first_column == -150);
  CHECK(frame.first_row == -250);
  CHECK(frame.columns == 151);
  CHECK(frame.rows == 251);
  std::uint64_t seen = 0;
  grid.each([&](std::int64_t column, std::int64_t row, const CellSums& sums) {
    CHECK(&sums == &grid.at(column, row));
    seen += sums.count();
  });
  CHECK(seen == 4);
}

TEST_CASE("memory is that of the blocks that have soundings") {
  SoundingGrid grid(1.0);
  CHECK(grid.bytes() == 0);
  grid.add(0.5, 0.5, 10.0, kNotStated);
  grid.add(7.5, 7.5, 10.0, kNotStated);
  const std::uint64_t one = grid.bytes();
  CHECK(one == 64 * sizeof(CellSums));
  grid.add(-1e6, 1e6, 10.0, kNotStated);
  CHECK(grid.bytes() == 2 * one);
}

TEST_CASE("a grid needs cells with a side") {
  CHECK_THROWS_AS(SoundingGrid(0.0), std::invalid_argument);
  CHECK_THROWS_AS(SoundingGrid(kNotStated), std::invalid_argument);
  CHECK(SoundingGrid(1.0).frame().columns == 0);
}

}  // namespace ensonify::survey_grid

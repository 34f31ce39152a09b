#include "kernels/water/column.h"

#include <catch2/catch.hpp>

using namespace ensonify::water;

namespace {

/// Warm and fresh above, cold and salt below, with a thermocline.
Column fjord() { return Column({{18, 28, 0, 8.1}, {16, 30, 10, 8.1}, {7, 33, 25, 8.0}, {6, 34, 120, 7.9}}); }

constexpr AbsorptionLaw kLaws[] = {AbsorptionLaw::kFrancoisGarrison, AbsorptionLaw::kAinslieMcColm};

}  // namespace

TEST_CASE("a column is linear between its samples and constant beyond them") {
  const Column column = fjord();
  CHECK(column.at(10).temperature_degc == 16);
  CHECK(column.at(17.5).temperature_degc == Approx(11.5));
  CHECK(column.at(17.5).salinity_psu == Approx(31.5));
  CHECK(column.at(72.5).ph == Approx(7.95));
  CHECK(column.at(72.5).depth_m == 72.5);
  CHECK(column.at(-3).temperature_degc == 18);
  CHECK(column.at(500).salinity_psu == 34);
  CHECK(column.at(500).depth_m == 500);  // pressure goes on
}

TEST_CASE("absorption along depth is the average over the path") {
  for (const AbsorptionLaw law : kLaws) {
    for (const double frequency_hz : {30e3, 300e3, 1e6}) {
      // Ten thousand slices of 15 mm, whose own error is below 1e-8; three nodes per layer leave 1e-5.
      const Column column = fjord();
      double sum = 0;
      for (int i = 0; i < 10000; ++i)
        sum += absorption_dbpm(law, frequency_hz, column.at(2.0 + 148.0 * (i + 0.5) / 1e4));
      const double mean = column.mean_absorption_dbpm(law, frequency_hz, 2, 150);
      CHECK(mean == Approx(sum / 1e4).epsilon(1e-5));
      CHECK(column.mean_absorption_dbpm(law, frequency_hz, 150, 2) == mean);
      CHECK(column.mean_absorption_dbpm(law, frequency_hz, 40, 40) ==
            absorption_dbpm(law, frequency_hz, column.at(40)));
    }
  }
}

TEST_CASE("a column that cannot be one is refused") {
  CHECK_THROWS_WITH(Column({}), "a water column needs at least one sample");
  CHECK_THROWS_WITH(Column({{.depth_m = 0}, {.depth_m = 5}, {.depth_m = 5}}),
                    "sample 2 of the water column lies at 5.000000 m, not below the one before it at 5.000000 m; "
                    "depths must rise");
}

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/acoustics/array/beam_layout.h"

using namespace ensonify::array;
using Catch::WithinAbs;
constexpr double kDeg = std::numbers::pi / 180.0;

TEST_CASE("a direction belongs to the sector that it lies deepest in") {
  const std::array<TransmitSector, 3> sectors{{{.centre_rad = -45 * kDeg, .width_rad = 40 * kDeg},
                                               {.centre_rad = 0.0, .width_rad = 60 * kDeg},  // overlaps both by 5 deg
                                               {.centre_rad = 45 * kDeg, .width_rad = 40 * kDeg}}};
  CHECK(sector_of(sectors, -65 * kDeg) == 0U);
  CHECK(sector_of(sectors, -65.1 * kDeg) == std::nullopt);
  CHECK(sector_of(sectors, 0.0) == 1U);
  CHECK(sector_of(sectors, 26.9 * kDeg) == 1U);  // 0.897 of a half width from 0, 0.905 from 45
  CHECK(sector_of(sectors, 27.1 * kDeg) == 2U);  // 0.903 and 0.895
  CHECK(sector_of(sectors, 65 * kDeg) == 2U);
  CHECK(sector_of({}, 0.0) == std::nullopt);

  const std::array<TransmitSector, 2> halves{
      {{.centre_rad = -0.5, .width_rad = 1.0}, {.centre_rad = 0.5, .width_rad = 1.0}}};
  CHECK(sector_of(halves, 0.0) == 0U);
  CHECK(sector_of(halves, 1e-6) == 1U);
}

TEST_CASE("a sector is flat inside, one half at its edges and -50 dB beyond its roll-off") {
  struct Row {
    double lower, upper, roll_off;
  };
  for (const Row& row : {Row{-0.9, 0.9, 0.2}, Row{-0.2, 0.6, 0.2}, Row{0.3, 0.5, 0.05}, Row{-0.5, 0.5, 0.02}}) {
    const SectorBeam beam = sector_beam(0.005, row.lower, row.upper, row.roll_off);
    const auto db = [&](double u) { return 10.0 * std::log10(power(beam.array, 0.005, u, beam.sin_steer)); };
    INFO("sector " << row.lower << ".." << row.upper << ", " << beam.array.elements() << " elements");
    CHECK_THAT(db(row.lower), WithinAbs(-6.02, 0.05));
    CHECK_THAT(db(row.upper), WithinAbs(-6.02, 0.05));
    double worst_inside_db = 0.0, highest_outside_db = -200.0;
    for (double u = -1.0; u <= 1.0; u += 0.0003) {
      const double inside = std::min(u - row.lower, row.upper - u);
      if (inside > 0.5 * row.roll_off) worst_inside_db = std::max(worst_inside_db, std::abs(db(u)));
      if (inside < -0.5 * row.roll_off) highest_outside_db = std::max(highest_outside_db, db(u));
    }
    CHECK(worst_inside_db < 0.04);
    CHECK(highest_outside_db < -50.0);
  }
}

TEST_CASE("a sector narrower than its roll-off is refused") {
  CHECK_THROWS_WITH(sector_beam(0.005, 0.0, 0.1, 0.2),
                    "a sector 0.100000 wide in sine with a roll-off of 0.200000: allowed 0.01 to its width");
}

#include "kernels/vertical/reduction.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/vertical/draught.h"
#include "kernels/vertical/tide.h"

using namespace ensonify::vertical;
using ensonify::frames::Vec2;
using ensonify::frames::Vec3;

namespace {

/// Surfaces that slope as real ones do: 10 mm of geoid and 2 mm of datum per kilometre.
Datums sloping() {
  std::vector<double> geoid, datum;
  for (int row = 0; row < 11; ++row) {
    for (int column = 0; column < 11; ++column) {
      geoid.push_back(46.0 + 0.01 * column + 0.004 * row);
      datum.push_back(-2.4 + 0.002 * row);
    }
  }
  return {Separation(Vec2(-5000, -5000), 1000, 11, 11, geoid), Separation(Vec2(-5000, -5000), 1000, 11, 11, datum)};
}

}  // namespace

TEST_CASE("GGA's height plus its undulation is the height above the ellipsoid") {
  const Datums datums = sloping();
  const Vec3 antenna(1234, -2345, 7.5);
  CHECK(geoid_height_m(datums, antenna) + datums.geoid_above_ellipsoid.at(antenna.head<2>()) ==
        Approx(ellipsoid_height_m(datums, antenna)));
  CHECK(geoid_height_m({}, antenna) == 7.5);
}

TEST_CASE("by tide gauge and by satellite a sounding has the same depth") {
  // A launch on a line through half a tide, settling as she speeds up, burning fuel, heaving: all inputs true.
  const Datums datums = sloping();
  const Tide tide(HarmonicTide{3.0, {{1.405189e-4, 2.1, 0.4}, {1.454441e-4, 0.7, 1.0}}});
  const Loading loading{{{0, 0.0}, {2, 0.02}, {5, 0.11}}, 0.03, -1e-6};
  const double seabed_m = -21.7;
  for (double t_s = 0.0; t_s < 22000.0; t_s += 1000.0) {
    const double speed_mps = t_s < 3000 ? 0.0 : 4.0, heave_m = 0.3 * std::sin(t_s);
    const double water_m = tide.at(t_s).height_m, sinkage = sinkage_m(loading, speed_mps, t_s);
    const Vec3 reference(0.2 * t_s - 2000, 500, water_m - sinkage + heave_m);
    const Vec3 transducer = reference - Vec3(0, 0, 0.8), antenna = reference + Vec3(0, 0, 4.2);
    const double below_transducer_m = transducer.z() - seabed_m;

    const double by_gauge = reduced_by_gauge_m(below_transducer_m, 0.8 + sinkage, heave_m, water_m);
    const double by_satellite =
        reduced_by_ellipsoid_m(below_transducer_m, ellipsoid_height_m(datums, antenna), 5.0, datums, antenna.head<2>());
    REQUIRE(by_gauge == Approx(21.7).margin(1e-9));  // the requirement is 0.02; with true inputs only rounding is left
    REQUIRE(by_satellite == Approx(21.7).margin(1e-9));
    CHECK(depth_below_water_m(transducer, water_m) == Approx(0.8 + sinkage - heave_m));
  }
}

TEST_CASE("one forgotten link of the chain shows as its own size") {
  const Datums datums = sloping();
  const Vec3 antenna(0, 0, 6.0);
  const double height_m = ellipsoid_height_m(datums, antenna);
  const double right = reduced_by_ellipsoid_m(20, height_m, 5, datums, {0, 0});
  const double without_datum =
      reduced_by_ellipsoid_m(20, height_m, 5, {datums.geoid_above_ellipsoid, Separation()}, {0, 0});
  CHECK(right - without_datum == Approx(datums.datum_above_geoid.at({0, 0})));
}

TEST_CASE("settlement is the table's, flat beyond it, and grows with its slope") {
  const Loading loading{{{0, 0.0}, {2, 0.02}, {5, 0.11}}, 0.0, 0.0};
  CHECK(sinkage_m(loading, 2.0, 0.0) == Approx(0.02));
  CHECK(sinkage_m(loading, 3.5, 0.0) == Approx(0.065));
  CHECK(sinkage_m(loading, 9.0, 0.0) == Approx(0.11));
  CHECK(sinkage_m({{}, 0.05, -1e-6}, 3.0, 10000.0) == Approx(0.04));
}

TEST_CASE("Barrass: a block coefficient of 0.7 at 8 knots squats 0.45 m") {
  CHECK(barrass_squat_m(0.7, 8.0 * 1852.0 / 3600.0) == Approx(0.448));
}

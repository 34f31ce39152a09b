#include "kernels/base/frames/local_projection.h"

#include <GeographicLib/TransverseMercatorExact.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify::frames;
using Catch::WithinAbs;
constexpr double kDeg = std::numbers::pi / 180.0;

TEST_CASE("the origin maps to zero, and a place maps back to itself") {
  const LocalProjection map({53.2, -9.1});
  CHECK(map.enu_of({53.2, -9.1}).norm() < 1e-9);
  const Geodetic back = map.geodetic_of(map.enu_of({53.31, -9.4}));
  CHECK_THAT(back.latitude_deg, WithinAbs(53.31, 1e-11));
  CHECK_THAT(back.longitude_deg, WithinAbs(-9.4, 1e-11));
}

TEST_CASE("a degree of meridian at the equator is 110574.4 m, and at the pole 111694 m") {
  // WGS 84 meridian arc, the integral of a (1 - e^2) / (1 - e^2 sin^2 B)^(3/2) dB: 110574.3886 m and 111693.8649 m.
  const LocalProjection equator({0.0, 10.0});
  CHECK_THAT(equator.enu_of({1.0, 10.0}).y(), WithinAbs(110574.389, 1e-3));
  const LocalProjection north({89.0, 10.0});
  CHECK_THAT(north.enu_of({90.0, 10.0}).y(), WithinAbs(111693.865, 1e-3));
}

TEST_CASE("scale is one at the origin") {
  // East by 1e-6 rad of longitude is N cos(latitude) 1e-6, N the prime vertical radius.
  const double latitude = 43.0, a = 6378137.0, e2 = 6.69437999014e-3;
  const double radius = a / std::sqrt(1 - e2 * std::pow(std::sin(latitude * kDeg), 2));
  const LocalProjection map({latitude, 5.0});
  CHECK(map.enu_of({latitude, 5.0 + 1e-6 / kDeg}).x() ==
        Approx(radius * std::cos(latitude * kDeg) * 1e-6).epsilon(1e-8));
}

TEST_CASE("true heading is grid heading plus convergence") {
  const LocalProjection map({60.0, 20.0});
  const Vec2 east(30'000.0, 0.0);
  // East of the centre in the northern hemisphere grid north lies clockwise of true north, by about dlon sin(lat).
  const Geodetic here = map.geodetic_of(east);
  CHECK(map.convergence_rad(east) ==
        Approx((here.longitude_deg - 20.0) * kDeg * std::sin(here.latitude_deg * kDeg)).epsilon(1e-4));
  // A short way along true north has grid bearing -convergence.
  const Vec2 step = map.enu_of({here.latitude_deg + 1e-4, here.longitude_deg}) - east;
  CHECK(std::atan2(step.x(), step.y()) == Approx(-map.convergence_rad(east)).epsilon(1e-5));
}

TEST_CASE("the series is the exact projection within 5 nm") {
  // [Karney2011], sec. 4: to the sixth order, within 3900 km. Metres of 1e6 have a rounding of their own of 0.1 to 1
  // nm.
  const auto& exact = GeographicLib::TransverseMercatorExact::UTM();  // WGS 84, scale 0.9996
  for (const double latitude : {-75.0, -30.0, 0.0, 44.0, 80.0}) {
    const LocalProjection map({latitude, 10.0});
    double x0 = 0.0, y0 = 0.0, x = 0.0, y = 0.0;
    exact.Forward(10.0, latitude, 10.0, x0, y0);
    for (const double east_deg : {0.001, 0.3, 4.0}) {
      const Geodetic place{latitude + 0.7 * east_deg, 10.0 + east_deg};
      exact.Forward(10.0, place.latitude_deg, place.longitude_deg, x, y);
      CHECK((map.enu_of(place) - Vec2(x, y - y0) / 0.9996).norm() < 7e-9);
      const Geodetic back = map.geodetic_of(map.enu_of(place));
      CHECK(std::abs(back.latitude_deg - place.latitude_deg) < 7e-9 / 111e3);
    }
  }
}

TEST_CASE("an origin off the globe is refused") {
  CHECK_THROWS_AS(LocalProjection({90.0, 0.0}), std::invalid_argument);
  CHECK_THROWS_AS(LocalProjection({std::nan(""), 0.0}), std::invalid_argument);
}

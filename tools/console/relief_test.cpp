#include "tools/console/relief.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "kernels/base/frames/local_projection.h"

using namespace ensonify;
using namespace ensonify::console;
using Catch::Matchers::WithinAbs;

namespace {

/// 11 x 21 posts of 10 m; heights rise by so much a metre.
msg::Chart plane(double east, double north) {
  msg::Chart chart;
  chart.origin_latitude_deg = 54.25;
  chart.origin_longitude_deg = -3.5;
  chart.west_m = -100.0;
  chart.south_m = 50.0;
  chart.spacing_m = 10.0;
  chart.shallowest_m = 10.0;
  chart.deepest_m = 30.0;
  chart.height_m = msg::Array<float>({11, 21});
  for (std::size_t row = 0; row < 11; ++row)
    for (std::size_t column = 0; column < 21; ++column)
      chart.height_m(row, column) = static_cast<float>(-20.0 + east * 10.0 * (static_cast<double>(column) - 10.0) +
                                                       north * 10.0 * (static_cast<double>(row) - 5.0));
  return chart;
}

}  // namespace

TEST_CASE("flat seabed has the light's height as shade, slopes to the north-west are brighter, others darker") {
  const int flat = relief_of(plane(0.0, 0.0)).shade(5, 10);
  CHECK(flat == std::lround(1.0 + 254.0 * std::sqrt(0.5)));
  CHECK(relief_of(plane(0.05, -0.05)).shade(5, 10) > flat + 20);  // falls to the north-west, and faces the light
  CHECK(relief_of(plane(-0.05, 0.05)).shade(5, 10) < flat - 20);
  msg::Chart hole = plane(0.0, 0.0);
  hole.height_m(5, 10) = std::nanf("");
  CHECK(relief_of(hole).shade(5, 10) == 0);
  CHECK(relief_of(hole).shade(5, 11) == flat);
}

TEST_CASE("contours of a plane lie where its depth is round") {
  const msg::ConsoleRelief relief = relief_of(plane(0.1, 0.0));  // 10 m to 30 m deep
  CHECK(relief.contour_step_m == 2.0);
  std::set<float> depths;
  for (std::size_t i = 0; i < relief.contour_depth_m.size(); ++i) {
    const float depth_m = relief.contour_depth_m[i];
    depths.insert(depth_m);
    CHECK_THAT(std::remainder(depth_m, 2.0), WithinAbs(0.0, 1e-6));
    for (const std::size_t end : {0U, 2U}) {
      const double east_m = relief.contour_m(i, end);
      CHECK_THAT(20.0 - 0.1 * east_m, WithinAbs(depth_m, 1e-3));
      CHECK(relief.contour_m(i, end + 1) >= 50.0F);
      CHECK(relief.contour_m(i, end + 1) <= 150.0F);
    }
  }
  CHECK(depths.size() >= 9);
}

TEST_CASE("contours have a bound, and a chart without heights has none") {
  msg::Chart rough = plane(0.0, 0.0);
  rough.height_m = msg::Array<float>({256, 256});
  for (std::size_t i = 0; i < rough.height_m.size(); ++i) rough.height_m[i] = i % 2 == 0 ? -10.0F : -30.0F;
  CHECK(relief_of(rough).contour_depth_m.size() <= kMostContourPieces + 1);
  msg::Chart none = plane(0.0, 0.0);
  none.height_m = {};
  CHECK(relief_of(none).shade.empty());
  CHECK(relief_of(none).projection.starts_with("+proj=tmerc +lat_0=54.25"));
}

TEST_CASE("a position in metres and degrees names the map") {
  const frames::LocalProjection world({54.25, -3.5});
  msg::Position position;
  position.position_enu_m = {4000.0, -2500.0, 0.0};
  const frames::Geodetic place = world.geodetic_of({4000.0, -2500.0});
  position.latitude_deg = place.latitude_deg;
  position.longitude_deg = place.longitude_deg;
  const auto map = map_of(position);
  REQUIRE(map);
  CHECK(map->projection == relief_of(plane(0.0, 0.0)).projection);
  CHECK(map->shade.empty());
  CHECK_FALSE(map_of(msg::Position{}));
  position.latitude_deg = 95.0;
  CHECK_FALSE(map_of(position));
}

TEST_CASE("steps of contours are round") {
  CHECK(contour_step(20.0) == 2.0);
  CHECK(contour_step(21.0) == 5.0);
  CHECK_THAT(contour_step(0.9), WithinAbs(0.1, 1e-12));
  CHECK(contour_step(0.0) == 1.0);
}

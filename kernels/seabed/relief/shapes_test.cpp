#include "kernels/seabed/relief/shapes.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/seabed/relief/mask.h"

using namespace ensonify::relief;
using Catch::WithinAbs;

namespace {

constexpr double kPi = std::numbers::pi, kSpacing = 0.25;

float at(const Field& field, double x_m, double y_m) {
  float value = 0.0F;
  field({0, std::llround(x_m / kSpacing), std::llround(y_m / kSpacing), 1, 1}, std::span(&value, 1));
  return value;
}

}  // namespace

TEST_CASE("a plane gets deeper downhill, with its slope everywhere") {
  const Field east = plane({.depth_m = 10.0, .slope = 0.1, .downhill_heading_rad = kPi / 2}, kSpacing);
  CHECK(at(east, 0, 0) == Approx(-10.0));
  CHECK(at(east, 30, 5) == Approx(-13.0));
  CHECK(at(slope_of(east, kSpacing, 2), 7, -3) == Approx(0.1).epsilon(1e-4));
}

TEST_CASE("a ramp drops over its run, a step at once") {
  const Field north = ramp({.middle_enu_m = {0, 10}, .depth_m = 10.0, .drop_m = 4.0, .run_m = 8.0}, kSpacing);
  CHECK(at(north, 3, 5.5) == Approx(-10.0));
  CHECK(at(north, 3, 10) == Approx(-12.0));
  CHECK(at(north, 3, 12) == Approx(-13.0));
  CHECK(at(north, 3, 20) == Approx(-14.0));
  const Field step = ramp({.depth_m = 10.0, .drop_m = 4.0}, kSpacing);
  CHECK(at(step, 3, -0.25) == -10.0F);
  CHECK(at(step, 3, 0.0) == -14.0F);
}

TEST_CASE("a wave has its amplitude and length, a sphere its top and edge") {
  const Field waves =
      wave({.depth_m = 20.0, .amplitude_m = 0.5, .wavelength_m = 8.0, .heading_rad = kPi / 2}, kSpacing);
  CHECK(at(waves, 0, 3) == Approx(-19.5));
  CHECK(at(waves, 4, 3) == Approx(-20.5));
  CHECK_THAT(at(waves, 10, 3), WithinAbs(-20.0, 1e-5));
  const Field ball =
      sphere({.centre_enu_m = {5, 5}, .centre_depth_m = 19.0, .radius_m = 2.0, .depth_m = 20.0}, kSpacing);
  CHECK(at(ball, 5, 5) == Approx(-17.0));
  CHECK(at(ball, 6, 5) == Approx(-19.0 + std::sqrt(3.0)));
  CHECK(at(ball, 7.25, 5) == -20.0F);
  CHECK_THROWS_WITH(wave({.wavelength_m = 0.0}, kSpacing), "shape: wavelength_m is 0.000000, allowed: above 0");
  CHECK_THROWS_WITH(sphere({.radius_m = -1.0}, kSpacing), "shape: radius_m is -1.000000, allowed: above 0");
}

TEST_CASE("a ridge has its height on its line and half of it half a width away") {
  const Field crest = ridge({{0, -50}, {0, 50}, 4.0, 20.0}, kSpacing);
  CHECK(at(crest, 0, 10) == Approx(4.0));
  CHECK(at(crest, 10, 10) == Approx(2.0));
  CHECK(at(crest, 0, 60) == Approx(2.0));
  CHECK(at(crest, 0, 131) == 0.0F);
}

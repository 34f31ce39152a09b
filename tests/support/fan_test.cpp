#include "tests/support/fan.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify::trace;
using Catch::WithinAbs;
using ensonify::random::Stream;
const Stream kJitter{1, "rays"};

TEST_CASE("the solid angles of a fan sum to that of its volume") {
  const FanShape shape{.transmit_length_in_waves = 50, .along_reach = 8, .half_swath_rad = 1.2};
  Rays rays;
  Fan(shape).fill(kJitter, 0, rays);
  REQUIRE(rays.size() == 24 * 1024);
  double sum = 0;
  for (const Ray& ray : rays) {
    sum += ray.solid_angle_sr;
    REQUIRE_THAT(ray.direction_head.norm(), WithinAbs(1, 1e-6));
  }
  CHECK(sum == Approx(2 * 8.0 / 50 * 2 * 1.2).epsilon(1e-5));  // du dphi
}

TEST_CASE("rays integrate a function of direction") {
  // A cap of half angle 30 deg about the head's z axis has 2 pi (1 - cos 30) sr; a wide fan must find it.
  Rays rays;
  Fan({.transmit_length_in_waves = 1, .along_reach = 1, .half_swath_rad = 1.5, .along = 200, .across = 500})
      .fill(kJitter, 3, rays);
  double sum = 0;
  for (const Ray& ray : rays) {
    if (ray.direction_head.z() > std::cos(std::numbers::pi / 6)) sum += ray.solid_angle_sr;
  }
  CHECK(sum == Approx(2 * std::numbers::pi * (1 - std::cos(std::numbers::pi / 6))).epsilon(5e-3));
}

TEST_CASE("rays are dense where the pattern is high and where the seabed is grazing") {
  Rays rays;
  Fan({.transmit_length_in_waves = 50}).fill(kJitter, 0, rays);
  int inside_main_lobe = 0;
  for (const Ray& ray : rays) inside_main_lobe += std::abs(ray.direction_head.x()) < 1.0 / 50;
  CHECK(inside_main_lobe > 0.6 * rays.size());  // of the width they have an eighth
  const auto between = [&](double low_deg, double high_deg) {
    int count = 0;
    for (const Ray& ray : rays) {
      const double phi = std::atan2(ray.direction_head.y(), ray.direction_head.z()) * 180 / std::numbers::pi;
      count += phi > low_deg && phi < high_deg;
    }
    return count;
  };
  CHECK(between(60, 65) > 2 * between(5, 10));
}

TEST_CASE("rays repeat for a ping and move with the next") {
  Rays a, b, c;
  const Fan fan({});
  fan.fill(kJitter, 5, a);
  fan.fill(kJitter, 5, b);
  fan.fill(kJitter, 6, c);
  CHECK(a[77].direction_head == b[77].direction_head);
  CHECK(a[77].direction_head != c[77].direction_head);
}

TEST_CASE("a fan without rays or of a half circle is refused") {
  CHECK_THROWS_AS(Fan({.along = 0}), std::invalid_argument);
  CHECK_THROWS_AS(Fan({.half_swath_rad = 1.6}), std::invalid_argument);
}

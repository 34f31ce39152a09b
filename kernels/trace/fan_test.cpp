#include "kernels/trace/fan.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify::trace;
using ensonify::random::Stream;
const Stream kJitter{1, "rays"};

TEST_CASE("the solid angles of a fan sum to that of its volume") {
  const FanShape shape{.transmit_length_in_waves = 50, .along_reach = 8, .half_swath_rad = 1.2};
  std::vector<Ray> rays;
  Fan(shape).fill(kJitter, 0, rays);
  REQUIRE(rays.size() == 24 * 1024);
  double sum = 0;
  for (const Ray& ray : rays) {
    sum += ray.solid_angle_sr;
    REQUIRE(ray.direction_head.norm() == Approx(1).margin(1e-6));
  }
  CHECK(sum == Approx(2 * 8.0 / 50 * 2 * 1.2).epsilon(1e-5));  // du dphi
}

TEST_CASE("rays integrate a function of direction") {
  // A cap of half angle 30 deg about the head's z axis has 2 pi (1 - cos 30) sr; a wide fan must find it.
  std::vector<Ray> rays;
  Fan({.transmit_length_in_waves = 1, .along_reach = 1, .half_swath_rad = 1.5, .along = 200, .across = 500})
      .fill(kJitter, 3, rays);
  double sum = 0;
  for (const Ray& ray : rays) {
    if (ray.direction_head.z() > std::cos(std::numbers::pi / 6)) sum += ray.solid_angle_sr;
  }
  CHECK(sum == Approx(2 * std::numbers::pi * (1 - std::cos(std::numbers::pi / 6))).epsilon(5e-3));
}

TEST_CASE("rays are dense where the pattern is high and where the seabed is grazing") {
  std::vector<Ray> rays;
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
  std::vector<Ray> a, b, c;
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

/// Slant ranges that a side fan's look meets on a level seabed 10 m below, within 100 m.
static std::vector<float> level_seabed(const SideFan& fan) {
  std::vector<float> met;
  for (const Ray& ray : fan.look()) {
    const float range = ray.direction_head.z() > 0.0F ? 10.0F / ray.direction_head.z() : 1e9F;
    met.push_back(range <= 100.0F ? range : 0.0F);
  }
  return met;
}

TEST_CASE("a side fan spreads its rows over slant range, and its solid angles sum to the volume's") {
  SideFan fan({.transmit_length_in_waves = 200, .from_rad = -1.75, .to_rad = 1.75, .along = 4, .across = 4000});
  std::vector<Ray> rays;
  fan.fill(level_seabed(fan), kJitter, 0, rays);
  REQUIRE(rays.size() == fan.size());
  REQUIRE(rays.size() == 4 * 4000);
  double sum = 0;
  int to_port[9] = {}, to_starboard[9] = {};  // by 10 m of slant range from 10 m on
  for (const Ray& ray : rays) {
    sum += ray.solid_angle_sr;
    const double range = ray.direction_head.z() > 0 ? 10 / double(ray.direction_head.z()) : 1e9;
    if (range < 100) ++(ray.direction_head.y() < 0 ? to_port : to_starboard)[int((range - 10) / 10)];
  }
  CHECK(sum == Approx(2 * 8.0 / 200 * 3.5).epsilon(1e-5));
  // 70 % of 4000 rows over 2 x 90 m of slant range: 155 per 10 m. The last stretch ends between two looks, 3.3 m apart
  // there; the share of angle adds rows near the vertical.
  for (int stretch = 0; stretch < 9; ++stretch) {
    INFO("from " << 10 + 10 * stretch << " m");
    CHECK(to_port[stretch] > 4 * 140);
    CHECK(to_starboard[stretch] > 4 * 140);
    if (stretch > 2) CHECK(to_starboard[stretch] < 4 * 200);
  }
}

TEST_CASE("a side fan above nothing looks everywhere, and the same look gives the same rays") {
  SideFan fan({.from_rad = -1, .to_rad = 1, .along = 2, .across = 100, .look = 10});
  std::vector<Ray> rays, again;
  fan.fill(std::vector<float>(10), kJitter, 5, rays);
  fan.fill(std::vector<float>(10), kJitter, 5, again);
  int starboard = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    REQUIRE(rays[i].direction_head == again[i].direction_head);
    starboard += rays[i].direction_head.y() > 0;
  }
  CHECK(starboard == 100);
  CHECK_THROWS_AS(SideFan({.from_rad = 1, .to_rad = 1}), std::invalid_argument);
  CHECK_THROWS_AS(SideFan({.from_rad = -4, .to_rad = 1}), std::invalid_argument);
  CHECK_THROWS_AS(fan.fill(std::vector<float>(9), kJitter, 5, rays), std::invalid_argument);
}

#include "kernels/mesh/lod/frustum.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/base/random/stream.h"
#include "kernels/water/refraction/eigenray.h"
#include "kernels/water/refraction/thermocline.h"

using namespace ensonify;
using namespace ensonify::lod;
using frames::Vec3;
using std::numbers::pi;

namespace {

const random::Stream draws(7, "frustums");

/// Somewhere, turned anyhow; its span of sines and of angles is narrow or wide.
Frustum some_frustum(std::uint64_t i) {
  const auto u = [&](std::uint64_t k) { return draws.uniform(i, k); };
  const frames::Quaternion turn =
      frames::Quaternion(draws.normal(i, 20), draws.normal(i, 21), draws.normal(i, 22), draws.normal(i, 23))
          .normalized();
  Frustum f;
  f.apex_enu_m = {10 * u(0), 10 * u(1), -10 * u(2)};
  f.axis_enu = turn * Vec3::UnitX();
  f.side_enu = turn * Vec3::UnitY();
  f.zero_enu = turn * Vec3::UnitZ();
  f.low_sine = -0.95 + 1.8 * u(3);
  f.high_sine = std::min(1.0, f.low_sine + std::pow(u(4), 3.0));
  f.low_angle_rad = 4 * pi * (u(5) - 0.5);
  f.high_angle_rad = f.low_angle_rad + 2 * pi * std::pow(u(6), 2.0);
  f.max_range_m = 20 + 100 * u(7);
  return f;
}

Vec3 direction(const Frustum& f, double sine, double angle) {
  return sine * f.axis_enu + std::sqrt(1 - sine * sine) * (std::sin(angle) * f.side_enu + std::cos(angle) * f.zero_enu);
}

bool holds(const Frustum& f, const Vec3& place) {
  const Vec3 to = place - f.apex_enu_m;
  const double sine = to.dot(f.axis_enu) / to.norm();
  const double middle = 0.5 * (f.low_angle_rad + f.high_angle_rad), half = 0.5 * (f.high_angle_rad - f.low_angle_rad);
  const double angle = std::atan2(to.dot(f.side_enu), to.dot(f.zero_enu));
  return to.norm() <= f.max_range_m && sine >= f.low_sine && sine <= f.high_sine &&
         std::abs(std::remainder(angle - middle, 2 * pi)) <= half;
}

Vec3 unit(std::uint64_t i, std::uint64_t k) {
  return Vec3(draws.normal(i, k), draws.normal(i, k + 1), draws.normal(i, k + 2)).normalized();
}

}  // namespace

TEST_CASE("a sphere that a straight path of the frustum touches intersects it") {
  int hits = 0;
  constexpr int kTrials = 200'000;
  for (std::uint64_t i = 0; i < kTrials; ++i) {
    const Frustum f = some_frustum(i);
    const double sine = std::lerp(f.low_sine, f.high_sine, draws.uniform(i, 8));
    const double angle = std::lerp(f.low_angle_rad, f.high_angle_rad, draws.uniform(i, 9));
    const Vec3 place = f.apex_enu_m + f.max_range_m * draws.uniform(i, 10) * direction(f, sine, angle);
    const double radius = 0.01 + 30 * std::pow(draws.uniform(i, 11), 4.0);
    hits += intersects(f, {place + 0.999 * radius * unit(i, 12), radius});
  }
  CHECK(hits == kTrials);
}

TEST_CASE("few spheres intersect that no path touches") {
  int hits = 0, touched = 0;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    Frustum f = some_frustum(i);
    f.high_sine = std::max(f.high_sine, f.low_sine + 0.05);  // wide enough for tries to find
    f.high_angle_rad = std::max(f.high_angle_rad, f.low_angle_rad + 0.2);
    const Sphere sphere{f.apex_enu_m + 120 * draws.uniform(i, 8) * unit(i, 12), 1 + 4 * draws.uniform(i, 9)};
    if (!intersects(f, sphere)) continue;
    ++hits;
    bool inside = holds(f, sphere.centre_enu_m);
    for (std::uint64_t k = 0; k < 1000 && !inside; ++k) {
      const double part = std::cbrt(draws.uniform(i, 50, k));
      const Vec3 to(draws.normal(i, 51, k), draws.normal(i, 52, k), draws.normal(i, 53, k));
      inside = holds(f, sphere.centre_enu_m + sphere.radius_m * part * to.normalized());
    }
    touched += inside;
  }
  REQUIRE(hits > 1000);
  // What is hit for nothing lies at the frustum's corners, or touches by less than 1000 tries find.
  CHECK(touched > 0.85 * hits);
}

TEST_CASE("a place on a refracted path of the frustum intersects it") {
  const auto summer = refraction::summer_thermocline();  // 1489.5 to 1522 m/s
  int hits = 0, refracted_away = 0, places = 0;
  for (std::uint64_t i = 0; i < 40'000; ++i) {
    Frustum f = some_frustum(i);
    const double depth = 2 + 30 * draws.uniform(i, 8);
    f.apex_enu_m.z() = -depth;
    f.max_range_m = 400;
    f.high_sine = std::min(1.0, f.low_sine + 0.1 * draws.uniform(i, 4));
    f.water = {1489.5, 1522.0, summer.speed_mps(depth)};
    const double sine = std::lerp(f.low_sine, f.high_sine, draws.uniform(i, 9));
    const double angle = std::lerp(f.low_angle_rad, f.high_angle_rad, draws.uniform(i, 10));
    const Vec3 start = direction(f, sine, angle);
    const double level = start.head<2>().norm();
    if (level < 1e-3) continue;
    const double horizontal = 300 * level * draws.uniform(i, 11);
    const auto end = refraction::path_at_horizontal(summer, depth, std::atan2(-start.z(), level), horizontal);
    if (end.path_length_m > 400 || end.depth_m < 0 || end.depth_m > 80) continue;
    ++places;
    const Vec3 place(f.apex_enu_m.x() + horizontal * start.x() / level,
                     f.apex_enu_m.y() + horizontal * start.y() / level, -end.depth_m);
    const Sphere sphere{place + 0.0499 * unit(i, 12), 0.05};
    hits += intersects(f, sphere);
    Frustum straight = f;
    straight.water = {};
    refracted_away += !intersects(straight, sphere);
  }
  REQUIRE(places > 10'000);
  CHECK(hits == places);
  CHECK(refracted_away > 1000);  // straight paths do not do
}

TEST_CASE("bending costs a fan that hangs straight down nothing along its track") {
  Frustum fan;
  fan.axis_enu = Vec3::UnitY();
  fan.side_enu = Vec3::UnitX();
  fan.zero_enu = -Vec3::UnitZ();
  fan.low_sine = -0.02;
  fan.high_sine = 0.02;
  fan.low_angle_rad = -1.13;
  fan.high_angle_rad = 1.13;
  fan.max_range_m = 150;
  Frustum refracted = fan;
  refracted.water = {1489.5, 1522.0, 1520.0};
  for (double x = -100; x <= 100; x += 5) {
    double straight_reach = 0, refracted_reach = 0;
    for (double y = 0; y < 30; y += 0.05) {
      if (intersects(fan, {{x, y, -50}, 2.0})) straight_reach = y;
      if (intersects(refracted, {{x, y, -50}, 2.0})) refracted_reach = y;
    }
    CHECK(refracted_reach >= straight_reach);
    CHECK(refracted_reach <= straight_reach + 0.9);  // most at 10 m from the head's track; less than half a radius
  }
}

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/acoustics/trace/scene.h"
#include "kernels/water/refraction/thermocline.h"

using namespace ensonify::trace;
using namespace ensonify::terrain;
using Catch::WithinAbs;
using ensonify::frames::HeadPose;
using ensonify::refraction::PathTable;
using ensonify::refraction::SoundSpeedProfile;
constexpr double kDeg = std::numbers::pi / 180;

/// Pointing straight down with forward to north, 2 m below the surface.
static const HeadPose kHead{{3.0, -4.0, -2.0}, ensonify::frames::enu_from_ned()};

static Ray ray(double azimuth_rad, double depression_rad) {
  const Vec3 ned(std::cos(depression_rad) * std::cos(azimuth_rad), std::cos(depression_rad) * std::sin(azimuth_rad),
                 std::sin(depression_rad));
  return {ned.cast<float>(), 1.0F};
}
static Rays rays_of_all_sides(double from_deg, double to_deg, int count) {
  Rays rays;
  for (int i = 0; i < count; ++i) rays.push_back(ray(2.4 * i, (from_deg + (to_deg - from_deg) * i / count) * kDeg));
  return rays;
}
static double depression(const Ray& r) {  // of the float direction, in double
  const Vec3 d = r.direction_head.cast<double>();
  return std::atan2(d.z(), std::hypot(d.x(), d.y()));
}

static Scene seabed(double (*height)(double, double), double half_m = 512) {
  Scene scene({0, 0});
  const TileGrid grid{.origin_enu_m = {-half_m, -half_m}, .spacing_m = half_m / 256, .cells = 256};
  for (int e : {0, 1})
    for (int n : {0, 1}) scene.insert({e, n}, sample_tile(grid, {e, n}, height));
  return scene;
}
static double flat80(double, double) { return -80.0; }
static double rolling(double x, double y) { return -77.0 + 2.4 * std::sin(0.1 * x) * std::cos(0.13 * y); }

static Hits trace(const Scene& scene, const SoundSpeedProfile& water, const Rays& rays, float range_m = 600,
                  const HeadPose& head = kHead) {
  PathTable paths;
  scene.adapted().tabulate(water, head, -head.position_enu_m.z(), range_m, paths);
  Hits hits;
  scene.adapted().trace(head, rays, range_m, hits, paths);
  return hits;
}

TEST_CASE("in uniform water bent rays are straight rays") {
  const Scene scene = seabed(rolling);
  const auto rays = rays_of_all_sides(9, 90, 2000);
  const auto refracted = trace(scene, SoundSpeedProfile::uniform(1480), rays);
  Hits straight;
  scene.adapted().trace(kHead, rays, 600, straight, 1480);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    REQUIRE(refracted[i].hit() == straight[i].hit());
    if (!refracted[i].hit()) continue;
    // A float of 500 m rounds by 15 um; at 9 degrees of grazing six times that along the seabed.
    REQUIRE((refracted[i].position_enu_m - straight[i].position_enu_m).norm() < 1e-3);
    REQUIRE(refracted[i].range_m == Approx(straight[i].range_m).epsilon(2e-6));
    REQUIRE(refracted[i].path_length_m == Approx(straight[i].path_length_m).epsilon(2e-6));
    REQUIRE(refracted[i].travel_time_s == Approx(straight[i].travel_time_s).epsilon(2e-6));
    REQUIRE(refracted[i].tube_m2 == Approx(straight[i].tube_m2).epsilon(3e-5));
    REQUIRE_THAT(refracted[i].sin_grazing, WithinAbs(straight[i].sin_grazing, 1e-6));
    REQUIRE((refracted[i].arrival_enu - straight[i].arrival_enu).norm() < 1e-6F);
    REQUIRE(refracted[i].contributor == straight[i].contributor);
  }
}

TEST_CASE("through a thermocline rays end within 1 mm of exact arcs, beyond 75 degrees") {
  const auto water = ensonify::refraction::summer_thermocline();
  auto rays = rays_of_all_sides(12, 90, 1500);
  rays.push_back(ray(0.3, 15 * kDeg));
  const auto hits = trace(seabed(flat80), water, rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    INFO(depression(rays[i]) / kDeg);
    const Hit& hit = hits[i];
    const auto exact = path_to_depth(water, 2, depression(rays[i]), 80);
    REQUIRE(exact);
    REQUIRE(hit.hit());
    const Vec3 off = hit.position_enu_m - kHead.position_enu_m;
    REQUIRE_THAT(std::hypot(off.x(), off.y()), WithinAbs(exact->horizontal_m, 1e-3));
    REQUIRE(hit.travel_time_s == Approx(exact->travel_time_s).epsilon(1e-6));
    REQUIRE(hit.path_length_m == Approx(exact->path_length_m).epsilon(2e-6));
    REQUIRE(hit.tube_m2 == Approx(exact->tube_m2).epsilon(1e-4));
    REQUIRE_THAT(hit.sin_grazing, WithinAbs(std::sin(exact->depression_rad), 1e-6));
    REQUIRE_THAT(hit.arrival_enu.z(), WithinAbs(-std::sin(exact->depression_rad), 1e-6));
  }
}

TEST_CASE("on relief in a gradient every hit lies on its path and no ray slips through") {
  const SoundSpeedProfile water({{0, 1530}, {70, 1490}, {76, 1481}, {90, 1475}});
  const auto rays = rays_of_all_sides(10, 80, 4000);
  const Scene scene = seabed(rolling);
  const auto hits = trace(scene, water, rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    REQUIRE(hits[i].hit());
    const Vec3 off = hits[i].position_enu_m - kHead.position_enu_m;
    const auto exact = path_at_horizontal(water, 2, depression(rays[i]), std::hypot(off.x(), off.y()));
    REQUIRE_THAT((exact.depth_m + hits[i].position_enu_m.z()) * std::cos(exact.depression_rad), WithinAbs(0, 1e-3));
    REQUIRE(hits[i].travel_time_s == Approx(exact.travel_time_s).epsilon(1e-6).margin(1e-3 / 1500));
    REQUIRE(hits[i].tube_m2 == Approx(exact.tube_m2).epsilon(1e-4));  // through the knot at 76 m too
  }
}

TEST_CASE("a head among the relief sees it through chords, upward slopes too") {
  // 0.5/s of gradient: chords of some 4 m. The head lies below the highest geometry, so nothing comes from the table.
  const SoundSpeedProfile water({{0, 1470}, {60, 1480}, {90, 1495}});
  const HeadPose low{{0, 0, -77.5}, ensonify::frames::enu_from_ned()};
  const Scene scene = seabed(
      +[](double x, double y) { return -80.0 + 0.1 * std::hypot(x, y); }, 64);
  const auto rays = rays_of_all_sides(2, 60, 1000);
  const auto hits = trace(scene, water, rays, 100, low);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    REQUIRE(hits[i].hit());
    const Vec3 off = hits[i].position_enu_m - low.position_enu_m;
    const auto exact = path_at_horizontal(water, 77.5, depression(rays[i]), std::hypot(off.x(), off.y()));
    REQUIRE_THAT((exact.depth_m + hits[i].position_enu_m.z()) * std::cos(exact.depression_rad), WithinAbs(0, 1e-3));
  }
}

TEST_CASE("rays that turn: up and back to the seabed, or away from it") {
  const auto thermocline = ensonify::refraction::summer_thermocline();
  const Scene scene = seabed(flat80, 2048);
  const HeadPose deep{{0, 0, -45}, ensonify::frames::enu_from_ned()};
  const Rays up{ray(1, -2 * kDeg), ray(2, -4 * kDeg), ray(3, -60 * kDeg)};
  const auto back = trace(scene, thermocline, up, 1500, deep);
  for (int i : {0, 1}) {
    const auto exact = path_to_depth(thermocline, 45, depression(up[i]), 80, 1);
    REQUIRE(exact);
    REQUIRE(back[i].hit());
    CHECK(std::hypot(back[i].position_enu_m.x(), back[i].position_enu_m.y()) ==
          Approx(exact->horizontal_m).epsilon(1e-5));
    CHECK(back[i].travel_time_s == Approx(exact->travel_time_s).epsilon(1e-6));
  }
  CHECK_FALSE(back[2].hit());

  const SoundSpeedProfile rising({{0, 1450}, {80, 1530}});  // bends everything up
  const auto lost = trace(scene, rising, {ray(0, 8 * kDeg), ray(0, 30 * kDeg)});
  CHECK_FALSE(lost[0].hit());  // turns at 1450 / cos(8 deg), 14 m down
  CHECK(lost[1].hit());
}

TEST_CASE("the greatest range is a length of path") {
  const auto water = ensonify::refraction::summer_thermocline();
  const Rays rays{ray(0, 20 * kDeg)};
  const double length = path_to_depth(water, 2, depression(rays[0]), 80)->path_length_m;
  CHECK(trace(seabed(flat80), water, rays, float(length + 0.1))[0].hit());
  CHECK_FALSE(trace(seabed(flat80), water, rays, float(length - 0.1))[0].hit());
}

TEST_CASE("a table that reaches too deep costs time, not hits; no tiles, no hits") {
  const auto water = ensonify::refraction::summer_thermocline();
  const auto rays = rays_of_all_sides(12, 90, 100);
  PathTable paths;
  paths.build(water, 2, 79.5);
  Hits hits;
  seabed(rolling).adapted().trace(kHead, rays, 600, hits, paths);
  const auto right = trace(seabed(rolling), water, rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    REQUIRE(hits[i].travel_time_s == Approx(right[i].travel_time_s).epsilon(1e-6));
  }
  CHECK_FALSE(trace(Scene({0, 0}), water, rays)[0].hit());
}

TEST_CASE("a bent ray continued behind a contributor hits what stands behind it") {
  const auto water = ensonify::refraction::summer_thermocline();
  Scene scene = seabed(flat80);
  ensonify::terrain::Tile plate = ensonify::terrain::sample_tile(
      {.origin_enu_m = {-500, -500}, .spacing_m = 10.0, .cells = 100}, {0, 0}, [](double, double) { return -30.0; });
  plate.sediment.assign(plate.height_m.size(), 7);
  scene.insert({9, 9}, plate);
  const auto rays = rays_of_all_sides(30, 90, 300);
  PathTable paths;
  scene.adapted().tabulate(water, kHead, 2, 600, paths);
  Hits first, behind;
  scene.adapted().trace(kHead, rays, 600, first, paths);
  scene.adapted().trace(kHead, rays, 600, behind, paths, sediment_contributor(7));
  const auto alone = trace(seabed(flat80), water, rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    REQUIRE(first[i].contributor == sediment_contributor(7));
    REQUIRE(behind[i].contributor == alone[i].contributor);
    REQUIRE_THAT(behind[i].position_enu_m.z(), WithinAbs(-80, 1e-3));
    REQUIRE(behind[i].travel_time_s == Approx(alone[i].travel_time_s).epsilon(1e-6));
  }
}

/// A shelf in the west, a deep floor in the east; with a mound of a few metres on its way down or without.
static double shelf(double x, double) { return x < 40.0 ? -20.0 : -60.0; }
static double shelf_and_mound(double x, double y) {
  return shelf(x, y) + (x > 60.0 && x < 100.0 && std::abs(y + 4.0) < 30.0 ? 30.0 : 0.0);
}

TEST_CASE("what a bent ray hits does not depend, to the bit, on what others of its packet hit") {
  // Below 35 m the speed rises so steeply that flat paths turn: where one of a packet goes on to there, it needs more
  // than a chord a layer. The mound keeps those rays above that depth, and must change no bit of the others.
  const SoundSpeedProfile water({{0, 1500}, {20, 1500}, {35, 1500}, {60, 1600}});
  Rays rays;
  for (int i = 0; i < 4000; ++i)  // neighbours go to the shelf, and to the deep
    rays.push_back(ray(i % 2 == 0 ? -1.5 : 1.6 + 0.02 * std::sin(i), (14 + 0.003 * i) * kDeg));
  const Hits without = trace(seabed(shelf), water, rays), with = trace(seabed(shelf_and_mound), water, rays);
  int same = 0, hidden = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!without[i].hit() || without[i].position_enu_m.z() < -21.0) {
      hidden += with[i].hit() && with[i].position_enu_m.z() > -35.0 ? 1 : 0;
      continue;
    }
    REQUIRE(without[i].position_enu_m == with[i].position_enu_m);
    REQUIRE(without[i].travel_time_s == with[i].travel_time_s);
    REQUIRE(without[i].path_length_m == with[i].path_length_m);
    REQUIRE(without[i].tube_m2 == with[i].tube_m2);
    REQUIRE(without[i].sin_grazing == with[i].sin_grazing);
    ++same;
  }
  CHECK(same > 1000);
  CHECK(hidden > 100);
}

TEST_CASE("bent rays are the same bits for any number of threads") {
  const auto water = ensonify::refraction::summer_thermocline();
  const Scene scene = seabed(rolling);
  const auto rays = rays_of_all_sides(-10, 90, 5000);
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return trace(scene, water, rays);
  };
  const auto one = with(1), two = with(2);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    REQUIRE(one[i].position_enu_m == two[i].position_enu_m);
    REQUIRE(one[i].travel_time_s == two[i].travel_time_s);
    REQUIRE(one[i].tube_m2 == two[i].tube_m2);
  }
}

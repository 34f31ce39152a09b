#include "kernels/acoustics/trace/scene.h"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "kernels/base/isa/isa.h"
#include "tests/support/fan.h"

using namespace ensonify::trace;
using namespace ensonify::terrain;
using Catch::WithinAbs;
using ensonify::frames::HeadPose;

static Tile tile_of(const TileGrid& grid, TileKey key, double (*height)(double, double)) {
  return sample_tile(grid, key, height);
}
static double flat(double, double) { return -20.0; }
static double slope(double x, double y) { return -20.0 + 0.1 * x - 0.2 * y; }
static double bumpy(double x, double y) { return -20.0 + std::sin(0.9 * x) * std::cos(1.3 * y); }

/// Pointing straight down with forward to north: head x = north, y = east, z = down.
static const HeadPose kLevel{{0.0, 0.0, 0.0}, ensonify::frames::enu_from_ned()};

static Ray towards(const Vec3& enu) {  // for a level head
  const Vec3 head = kLevel.enu_from_head.conjugate() * enu.normalized();
  return {head.cast<float>(), 1.0F};
}

TEST_CASE("a flat seabed is hit at depth over cosine, at the right grazing angle") {
  Scene scene({0, 0});
  scene.insert({0, 0}, tile_of({.origin_enu_m = {-64, -64}, .spacing_m = 0.5, .cells = 256}, {0, 0}, flat));
  const Rays rays{towards({0, 0, -1}), towards({1, 0, -1}), towards({0, -1, -2}), towards({0, 0, 1})};
  Hits hits;
  scene.adapted().trace(kLevel, rays, 100.0F, hits, 1480.0);
  CHECK(hits[0].range_m == Approx(20));
  CHECK(hits[0].travel_time_s == Approx(20 / 1480.0));
  CHECK(hits[0].sin_grazing == Approx(1));
  CHECK(hits[1].range_m == Approx(20 * std::sqrt(2.0)));
  CHECK(hits[1].sin_grazing == Approx(std::sqrt(0.5)));
  CHECK(hits[1].path_length_m == hits[1].range_m);
  CHECK(hits[1].tube_m2 == Approx(800));  // range squared
  CHECK((hits[1].arrival_enu - Eigen::Vector3f(1, 0, -1).normalized()).norm() < 1e-6F);
  CHECK((hits[1].position_enu_m - Vec3(20, 0, -20)).norm() < 1e-4);
  CHECK((hits[2].position_enu_m - Vec3(0, -10, -20)).norm() < 1e-4);
  CHECK(hits[2].normal_enu.z() == Approx(1));
  CHECK_FALSE(hits[3].hit());
  scene.adapted().trace(kLevel, rays, 19.0F, hits);
  CHECK_FALSE(hits[0].hit());
}

TEST_CASE("hits on a slope lie on the plane with its normal, also far from the origin") {
  for (const double far_m : {0.0, 50'000.0}) {
    const Vec2 origin(far_m, -far_m);
    Scene scene(origin);
    Tile tile = tile_of({.origin_enu_m = {-64, -64}, .spacing_m = 0.25, .cells = 512}, {0, 0}, slope);
    tile.origin_enu_m += origin;
    scene.insert({0, 0}, tile);
    HeadPose head = kLevel;
    head.position_enu_m += Vec3(origin.x(), origin.y(), 0);
    Rays rays;
    for (int i = 0; i < 100; ++i) rays.push_back(towards({std::sin(i), std::cos(1.7 * i), -1.0}));
    Hits hits;
    scene.adapted().trace(head, rays, 100.0F, hits);
    const Vec3 normal = Vec3(-0.1, 0.2, 1).normalized();
    for (const Hit& hit : hits) {
      REQUIRE(hit.hit());
      const Vec3 p = hit.position_enu_m - Vec3(origin.x(), origin.y(), 0);
      REQUIRE_THAT(p.z(), WithinAbs(slope(p.x(), p.y()), 2e-4));  // half a lattice step and float
      REQUIRE((hit.normal_enu.cast<double>() - normal).norm() < 2e-3);
    }
  }
}

TEST_CASE("no ray passes between neighbouring tiles") {
  const TileGrid grid{.origin_enu_m = {-16, -16}, .spacing_m = 0.25, .cells = 64};
  Scene scene({0, 0});
  for (int e : {0, 1})
    for (int n : {0, 1}) scene.insert({e, n}, tile_of(grid, {e, n}, bumpy));
  Rays rays;
  for (int i = -4000; i <= 4000; ++i) {
    const double along = i * 15.9 / 4000;
    rays.push_back(towards({0.0, along, bumpy(0.0, along)}));       // the seam x = 0
    rays.push_back(towards({along, 1e-7 * i, bumpy(along, 0.0)}));  // and about y = 0
  }
  Hits hits;
  scene.adapted().trace(kLevel, rays, 100.0F, hits);
  for (const Hit& hit : hits) REQUIRE(hit.hit());
}

TEST_CASE("a hole lets rays through its own four cells and no others") {
  Tile tile = tile_of({.origin_enu_m = {-32, -32}, .spacing_m = 0.5, .cells = 128}, {0, 0}, flat);
  tile.height_m[tile.post(70, 64)] = std::nanf("");  // at x = 3, y = 0
  tile.height_m[tile.post(20, 20)] = std::nanf("");
  Scene scene({0, 0});
  scene.insert({0, 0}, tile);
  Rays rays;
  std::vector<Vec2> places;
  for (double x = -30; x < 30; x += 0.37)
    for (double y = -30; y < 30; y += 0.41) {
      places.push_back({x, y});
      rays.push_back(towards({x, y, -20}));
    }
  Hits hits;
  scene.adapted().trace(kLevel, rays, 100.0F, hits);
  int missed = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    REQUIRE(hits[i].hit() == height_m(tile, places[i]).has_value());
    missed += !hits[i].hit();
  }
  CHECK(missed > 4);
}

TEST_CASE("an all-hole tile and an empty scene answer nothing") {
  Tile tile = tile_of({.origin_enu_m = {-4, -4}, .spacing_m = 0.5, .cells = 16}, {0, 0}, flat);
  tile.height_m.assign(tile.height_m.size(), std::nanf(""));
  Scene scene({0, 0});
  Hits hits;
  const Rays rays{towards({0, 0, -1})};
  scene.adapted().trace(kLevel, rays, 100.0F, hits);
  CHECK_FALSE(hits[0].hit());
  scene.insert({0, 0}, tile);
  scene.adapted().trace(kLevel, rays, 100.0F, hits);
  CHECK_FALSE(hits[0].hit());
}

TEST_CASE("a scene leaves the process as many threads as it had") {
  using tbb::global_control;
  const std::size_t threads = global_control::active_value(global_control::max_allowed_parallelism);
  REQUIRE(threads > 1);  // Embree's TBB has at least two, on one core too
  Scene scene({0, 0});
  scene.insert({0, 0}, tile_of({.origin_enu_m = {-16, -16}, .spacing_m = 0.5, .cells = 64}, {0, 0}, flat));
  CHECK(global_control::active_value(global_control::max_allowed_parallelism) == threads);
}

TEST_CASE("threads, the order of insertion and removed tiles change no bit") {
  const TileGrid grid{.origin_enu_m = {-64, -64}, .spacing_m = 0.5, .cells = 128};
  const auto key = [](int i) { return TileKey{i % 2, i / 2}; };
  Scene scene({0, 0}), other({7, 7});
  for (int i : {0, 1, 2, 3}) scene.insert(key(i), tile_of(grid, key(i), bumpy));
  other.insert({9, 9}, tile_of(grid, {0, 0}, flat));
  for (int i : {3, 1, 0, 2}) other.insert(key(i), tile_of(grid, key(i), bumpy));
  CHECK(other.remove({9, 9}));
  CHECK_FALSE(other.remove({9, 9}));
  other.centre_near({-1000, 1000});
  CHECK(other.size() == 4);

  Rays rays;
  Fan({}).fill({1, "rays"}, 0, rays);
  const HeadPose head{{0.1, 0.2, -1.0}, enu_from_body(ensonify::frames::Attitude{0.3, 0.02, -0.1})};
  const auto trace_with = [&](const Scene& s, std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Hits hits;
    s.adapted().trace(head, rays, 200.0F, hits);
    return hits;
  };
  const auto one = trace_with(scene, 1), two = trace_with(scene, 2), reordered = trace_with(other, 2);
  for (std::size_t i = 0; i < one.size(); ++i) {
    REQUIRE(one[i].range_m == two[i].range_m);
    REQUIRE(one[i].normal_enu == two[i].normal_enu);
    REQUIRE(one[i].position_enu_m == two[i].position_enu_m);
    REQUIRE(one[i].range_m == reordered[i].range_m);
    REQUIRE(one[i].normal_enu == reordered[i].normal_enu);
  }
}

TEST_CASE("the class of a hit is that of the seabed there") {
  Tile tile = tile_of({.origin_enu_m = {-32, -32}, .spacing_m = 0.5, .cells = 128}, {0, 0}, flat);
  tile.sediment.assign(tile.height_m.size(), 3);
  for (int row = 0; row < tile.rows; ++row)
    for (int column = 65; column < tile.columns; ++column) tile.sediment[tile.post(column, row)] = 5;
  Scene scene({0, 0});
  scene.insert({0, 0}, tile);
  const Rays rays{towards({-1, 0, -20}), towards({1, 0, -20})};
  Hits hits;
  scene.adapted().trace(kLevel, rays, 100.0F, hits);
  CHECK(hits[0].contributor == sediment_contributor(3));
  CHECK(hits[1].contributor == sediment_contributor(5));
}

TEST_CASE("a ray continued behind a contributor hits what stands behind it") {
  // A plate of two layers, 10 and 8 m above the seabed; beside it rays are as they were.
  Scene scene({0, 0});
  scene.insert({0, 0}, tile_of({.origin_enu_m = {-32, -32}, .spacing_m = 0.5, .cells = 128}, {0, 0}, flat));
  const auto add = [&](std::int32_t key, double (*height)(double, double)) {
    Tile plate = tile_of({.origin_enu_m = {-4, -4}, .spacing_m = 0.5, .cells = 16}, {0, 0}, height);
    plate.sediment.assign(plate.height_m.size(), 7);
    scene.insert({key, key}, plate);
  };
  add(8, [](double, double) { return -10.0; });
  add(9, [](double, double) { return -12.0; });
  const Rays rays{towards({0.1, 0.2, -1}), towards({1, 0, -1})};
  Hits first, behind, another;
  scene.adapted().trace(kLevel, rays, 100.0F, first);
  scene.adapted().trace(kLevel, rays, 100.0F, behind, 1500.0, sediment_contributor(7));
  scene.adapted().trace(kLevel, rays, 100.0F, another, 1500.0, sediment_contributor(6));
  CHECK(first[0].contributor == sediment_contributor(7));
  CHECK(first[0].position_enu_m.z() == Approx(-10));
  CHECK(behind[0].contributor == sediment_contributor(0));
  CHECK(behind[0].position_enu_m.z() == Approx(-20));
  CHECK(behind[1].position_enu_m == first[1].position_enu_m);
  CHECK(another[0].position_enu_m == first[0].position_enu_m);
  scene.adapted().trace(kLevel, rays, 15.0F, behind, 1500.0, sediment_contributor(7));
  CHECK_FALSE(behind[0].hit());  // the seabed lies beyond the range
}

TEST_CASE("a tile whose sizes do not fit is refused") {
  Tile tile;
  tile.columns = tile.rows = 3;
  Scene scene({0, 0});
  CHECK_THROWS_WITH(scene.insert({0, 0}, tile), "the number of heights is not columns x rows");
}

TEST_CASE("wider vector instructions change what rays hit by rounding alone") {
  using ensonify::Isa;
  if (ensonify::widest_isa() == Isa::kAvx2) {
    WARN("skipped: this machine has no AVX-512");
    return;
  }
  Rays rays;
  Fan({.transmit_length_in_waves = 50.0, .half_swath_rad = 1.0, .along = 16, .across = 2000})
      .fill({1, "rays"}, 0, rays);
  const auto hits_with = [&](Isa isa) {
    ensonify::use_isa(isa);
    Scene scene({0, 0});
    scene.insert({0, 0}, tile_of({.origin_enu_m = {-64, -64}, .spacing_m = 0.5, .cells = 256}, {0, 0}, bumpy));
    Hits hits;
    scene.adapted().trace(kLevel, rays, 100.0F, hits);
    ensonify::use_isa(Isa::kAvx2);
    return hits;
  };
  const Hits narrow = hits_with(Isa::kAvx2), wide = hits_with(Isa::kAvx512);
  std::size_t hit = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    REQUIRE(wide.hit(i) == narrow.hit(i));
    if (!narrow.hit(i)) continue;
    ++hit;
    // A ray within rounding of an edge may take the facet beyond it. Floats of 50 m are 4e-6 m apart.
    REQUIRE_THAT(wide.range_m[i], WithinAbs(narrow.range_m[i], 2e-4));
    REQUIRE((wide.position_enu_m[i] - narrow.position_enu_m[i]).norm() < 2e-4);
  }
  CHECK(hit > rays.size() / 2);
}

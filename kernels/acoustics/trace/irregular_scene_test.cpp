// Irregular meshes in a scene of tiles.
#include <tbb/global_control.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "kernels/acoustics/trace/testing/adapted.h"
#include "kernels/base/random/stream.h"
#include "kernels/mesh/progressive/hierarchy.h"
#include "kernels/mesh/progressive/objects.h"
#include "kernels/mesh/progressive/testing/meshes.h"

using namespace ensonify;
using namespace ensonify::trace;
using namespace ensonify::trace::adapted;
using Catch::WithinAbs;
using frames::HeadPose;
using frames::Vec2;
using frames::Vec3;

namespace {

constexpr float kRange_m = 60.0F;
constexpr std::uint8_t kSteel = 4;

/// 120 m of sheet piles along y = 0, from 14 m below the surface up to it.
const IrregularMesh& wall() {
  static const IrregularMesh made = [] {
    const progressive::SheetPileWall wall{
        .from_enu_m = {-60.0, 0.0}, .to_enu_m = {60.0, 0.0}, .foot_depth_m = 14.0, .row_m = 0.5};
    const auto mesh = progressive::mesh_of(wall, {1, "wall"});
    return IrregularMesh{progressive::hierarchy_of(mesh, progressive::collapses_of(mesh)), kSteel};
  }();
  return made;
}

/// Rough, so that most of it is left by nothing but views: half a metre of coral, its posts 13 cm apart.
const IrregularMesh& reef() {
  static const IrregularMesh made = [] {
    const random::Stream rough{3, "reef"};
    auto mesh = progressive::sheet(120, 120, [&](int i, int j) {
      const double knob = 0.1 * rough.normal(static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(j));
      return Vec3(0.13 * i - 8.0, 0.13 * j - 8.0, 0.4 + 0.3 * std::sin(0.3 * i) + knob).cast<float>().eval();
    });
    mesh.origin_enu_m = {-20.0, -14.0, -12.0};
    return IrregularMesh{progressive::hierarchy_of(mesh, progressive::collapses_of(mesh)), 7};
  }();
  return made;
}

Scene scene_of(const LevelOfDetail& detail, bool backwards = false) {
  Scene scene({0, 0}, detail);
  const terrain::TileGrid grid{.origin_enu_m = {-64.0, -64.0}, .spacing_m = 0.5, .cells = 256};
  const auto ground = [&] {
    scene.insert({0, 0}, terrain::sample_tile(grid, {0, 0}, [](double x, double y) {
                   return -12.0 + 0.3 * std::sin(0.3 * x) * std::cos(0.2 * y);
                 }));
  };
  if (!backwards) ground();
  scene.insert(backwards ? 1 : 0, backwards ? reef() : wall());
  scene.insert(backwards ? 0 : 1, backwards ? wall() : reef());
  if (backwards) ground();
  return scene;
}

const Scene& full() {
  static const Scene scene = scene_of({});
  return scene;
}

/// South of the wall, along it, passing over the reef, and turning.
HeadPose pose(int ping) {
  return {{-30.0 + 4.0 * ping, -9.0 - 0.4 * ping, -3.0}, enu_from_body(frames::Attitude{1.5 + 0.1 * ping, 0.03, 0.4})};
}

std::size_t on(std::uint8_t sediment, const Hits& hits) {
  std::size_t count = 0;
  for (const Hit hit : hits) count += hit.hit() && hit.contributor == sediment_contributor(sediment) ? 1U : 0U;
  return count;
}

}  // namespace

TEST_CASE("main lobe rays hit wall and reef bit-equal to the whole meshes", "[long]") {
  Scene scene = scene_of({.enabled = true});
  std::size_t different = 0, wall_hits = 0, reef_hits = 0, beyond_differ = 0;
  for (int ping = 0; ping < 6; ++ping) {
    const auto found = ping_differences(full(), scene, pose(ping), kRange_m, rays_of(ping, 50'000, Lobes::kMain),
                                        rays_of(ping, 10'000, Lobes::kAll), {.head_m = 3.0, .bottom_m = 14.0});
    different += found.main_lobe;
    beyond_differ += found.all_round;
    wall_hits += on(kSteel, found.hits), reef_hits += on(7, found.hits);
  }
  CHECK(different == 0);
  CHECK(wall_hits > 20'000);
  CHECK(reef_hits > 5'000);
  CHECK(beyond_differ > 1'000);  // they do see another mesh
}

TEST_CASE("no ray that a view allows is lost through a wall, whatever is refined of it") {
  Scene scene = scene_of({.enabled = true});
  const random::Stream draws(5, "aims");
  std::size_t behind = 0, aimed = 0;
  for (int ping = 0; ping < 6; ++ping) {
    const HeadPose head = pose(ping);
    const Mesh mesh = scene.adapted(views_at(head, kRange_m));
    Rays rays;
    for (std::uint64_t i = 0; i < 400'000; ++i) {
      const auto k = static_cast<std::uint64_t>(ping);
      // A third at vertices' columns, 0.6 m apart from 0.15 m on, and a third at their rows.
      double x = head.position_enu_m.x() + 16.0 * (draws.uniform(k, i, 0) - 0.5);
      double z = -10.5 * draws.uniform(k, i, 1) - 0.7;
      if (i % 3 == 0) x = 0.6 * std::round(x / 0.6) + 0.15;
      if (i % 3 == 1) z = 0.5 * std::round(2.0 * z);
      const Vec3 to = Vec3(x, 0.0, z) - head.position_enu_m;
      const Vec3 along = head.enu_from_head.conjugate() * to.normalized();
      const double angle = std::atan2(along.y(), along.z());
      if (kFan.sine.low < along.x() && along.x() < kFan.sine.high && kFan.angle_rad.low < angle &&
          angle < kFan.angle_rad.high && to.norm() < static_cast<double>(kRange_m))
        rays.push_back({along.cast<float>(), 1.0F});
    }
    Hits hits;
    mesh.trace(head, rays, 500.0F, hits);
    aimed += rays.size();
    // Nothing else is farther north than the wall stands out: what is hit there came through it.
    for (const Hit hit : hits) behind += !hit.hit() || hit.position_enu_m.y() > 0.5 ? 1U : 0U;
  }
  CHECK(aimed > 200'000);
  CHECK(behind == 0);
}

TEST_CASE("a ping's mesh among irregular meshes depends on neither history nor threads") {
  Scene wandering = scene_of({.enabled = true}), fresh = scene_of({.enabled = true}, true);
  for (const int ping : {5, 0, 3}) wandering.adapted(views_at(pose(ping), kRange_m));
  CHECK(wandering.remove(0));
  CHECK_FALSE(wandering.remove(0));
  wandering.adapted(views_at(pose(1), kRange_m));
  wandering.insert(0, wall());
  wandering.centre_near({5000.0, 0.0});
  wandering.centre_near({0.0, 0.0});
  const auto rays = rays_of(2, 50'000, Lobes::kAll);
  Hits a, b;
  wandering.adapted(views_at(pose(2), kRange_m)).trace(pose(2), rays, kRange_m, a);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  fresh.adapted(views_at(pose(2), kRange_m)).trace(pose(2), rays, kRange_m, b);
  CHECK(differences(a, b) == 0);
  CHECK(wandering.triangles() == fresh.triangles());
}

TEST_CASE("an added wall is hit, a removed one is not, with and without level of detail") {
  for (const bool enabled : {false, true}) {
    Scene scene({0, 0}, {.enabled = enabled});
    const HeadPose head{{0.0, -20.0, -5.0}, enu_from_body(frames::Attitude{0.0, 0.0, 0.0})};
    const Rays north{{Eigen::Vector3f::UnitX(), 1.0F}};
    lod::View ahead;
    ahead.frustum.apex_enu_m = head.position_enu_m;
    ahead.frustum.axis_enu = Vec3::UnitY(), ahead.frustum.zero_enu = Vec3::UnitZ(),
    ahead.frustum.side_enu = Vec3::UnitX();
    ahead.frustum.low_sine = 0.99, ahead.frustum.low_angle_rad = -3.2, ahead.frustum.high_angle_rad = 3.2;
    ahead.frustum.max_range_m = 100.0;
    Hits hits;
    scene.insert(7, wall());
    scene.adapted(std::array{ahead}).trace(head, north, 100.0F, hits);
    REQUIRE(hits[0].hit());
    // Half the section's depth and four deviations of a pile.
    CHECK_THAT(hits[0].range_m, WithinAbs(20.0, 0.215 + 0.06));
    CHECK(hits[0].contributor == sediment_contributor(kSteel));
    CHECK(hits[0].facet_m > 0.3F);
    CHECK_THAT(scene.heights_near({0.0, -20.0}, 30.0)->highest_m, WithinAbs(0.0, 1e-5));
    CHECK_FALSE(scene.heights_near({0.0, -20.0}, 10.0).has_value());
    CHECK(scene.remove(7));
    scene.adapted(std::array{ahead}).trace(head, north, 100.0F, hits);
    CHECK_FALSE(hits[0].hit());
  }
}

TEST_CASE("side lobe levels of wall and reef are the whole meshes' within 0.1 dB", "[long]") {
  Scene scene = scene_of({.enabled = true});
  std::map<std::uint8_t, double> all_sum, some_sum;
  Hits hits;
  const auto add_power = [&](const Mesh& seen, const HeadPose& head, const Rays& rays,
                             std::map<std::uint8_t, double>& sum) {
    seen.trace(head, rays, kRange_m, hits);
    for (const Hit hit : hits) {  // of a ray by Lambert's law: solid angle over range squared and sine of grazing
      const double sine_over_range = static_cast<double>(hit.sin_grazing / std::max(1.0F, hit.range_m));
      if (hit.hit()) sum[Contributors()[hit.contributor].sediment] += sine_over_range * sine_over_range;
    }
  };
  for (int ping = 0; ping < 6; ++ping) {
    const auto rays = rays_of(ping, 100'000, Lobes::kSide);
    add_power(full().adapted(), pose(ping), rays, all_sum);
    add_power(scene.adapted(views_at(pose(ping), kRange_m)), pose(ping), rays, some_sum);
  }
  for (const std::uint8_t sediment : {kSteel, std::uint8_t{7}}) {
    INFO(int{sediment});
    CHECK(all_sum[sediment] > 0.0);
    CHECK_THAT(10.0 * std::log10(some_sum[sediment] / all_sum[sediment]), WithinAbs(0.0, 0.1));
  }
}

TEST_CASE("a mesh smaller than the probes' spacing has the level of rays at it alone", "[long]") {
  // A ball of 0.4 m on the ground, ahead of an imaging head 2 m above it at preview's quality: no facet has rays of its
  // own. Over 40 draws of the rays its power deviates by 0.4 % at 10 m and by 3.9 % at 60 m; four times that, and 0.5 %
  // of the rays at it alone, are 0.1 dB and 0.7 dB.
  TransmitVolume volume;
  volume.axis = TransmitVolume::Axis::kDown;
  volume.sine = {-0.2, 0.4, -0.2, 0.4, 0.35};
  volume.angle_rad = {-1.13, 1.13, -1.13, 1.13, 0.0175};
  const HeadPose head{{0.0, 0.0, -8.0}, enu_from_body(frames::Attitude{})};
  constexpr float kFar_m = 100.0F;
  for (const auto& [away_m, most_db] : {std::pair{10.0, 0.1}, {60.0, 0.7}}) {
    auto ball = progressive::bumpy_ball(48, 24);
    for (auto& vertex : ball.vertex_m) vertex *= 0.02F;
    ball.origin_enu_m = {1.0, away_m, -9.8};
    Scene scene({0, 0});
    const terrain::TileGrid grid{.origin_enu_m = {-128.0, -64.0}, .spacing_m = 1.0, .cells = 256};
    scene.insert({0, 0}, terrain::sample_tile(grid, {0, 0}, [](double, double) { return -10.0; }));
    scene.insert(0, IrregularMesh{progressive::hierarchy_of(ball, progressive::collapses_of(ball)), kSteel});
    Hits hits;
    const auto power = [&](const Rays& rays) {  // by Lambert's law, once the rays have been traced
      double sum = 0.0;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const double sine_over_range = static_cast<double>(hits[i].sin_grazing / std::max(1.0F, hits[i].range_m));
        if (hits[i].hit() && hits[i].contributor == sediment_contributor(kSteel))
          sum += static_cast<double>(rays[i].solid_angle_sr) * sine_over_range * sine_over_range;
      }
      return sum;
    };
    const random::Stream draws(17, "at the ball");
    constexpr std::uint64_t kRays = 100'000;
    const Vec3 middle = head.enu_from_head.conjugate() * (ball.origin_enu_m - head.position_enu_m);
    const double half = 0.3 / away_m;
    Rays at_ball;
    for (std::uint64_t i = 0; i < kRays; ++i) {
      const double u = middle.z() / middle.norm() + half * (2.0 * draws.uniform(i, 0) - 1.0);
      const double phi = std::atan2(middle.y(), middle.x()) + half * (2.0 * draws.uniform(i, 1) - 1.0);
      const double beside = std::sqrt(1.0 - u * u);
      at_ball.push_back({Vec3(beside * std::cos(phi), beside * std::sin(phi), u).cast<float>(),
                         static_cast<float>(4.0 * half * half / kRays)});
    }
    const Mesh mesh = scene.adapted();
    mesh.trace(head, at_ball, kFar_m, hits);
    const double wanted = power(at_ball);
    REQUIRE(wanted > 0.0);
    for (std::uint64_t draw = 0; draw < 3; ++draw) {
      RayDistribution distribution(volume, {.quality = RaySettings::kPreview, .range_resolution_m = 0.02},
                                   {draw, "rays"});
      RayDistribution::Plan plan;
      RayDistribution::Batch all;
      const auto trace = [&](const Rays& rays, Hits& hit) { mesh.trace(head, rays, kFar_m, hit); };
      distribution.aim(head, {}, scene.objects(), kFar_m, nullptr, trace, plan);
      distribution.trace(plan, 0, plan.rays(), trace, all);
      hits = all.hits;
      CHECK_THAT(10.0 * std::log10(power(all.rays) / wanted), WithinAbs(0.0, most_db));
    }
  }
}

TEST_CASE("far fewer triangles are held than a mesh has") {
  Scene scene = scene_of({.enabled = true});
  const auto triangles = [&](const HeadPose& head) {
    scene.adapted(views_at(head, kRange_m));
    return scene.triangles();
  };
  // No view holds the wall or the reef: what is left of both, and of the tile.
  CHECK(triangles({{0.0, 500.0, -3.0}, enu_from_body(frames::Attitude{})}) < 3'000);
  // Of the small tile below, blocks of 64 cells that the fan intersects are there whole.
  full().adapted();  // the whole is held once it is traced
  CHECK(triangles(pose(4)) * 3 < full().triangles());
}

TEST_CASE("a mesh with a fault is refused") {
  Scene scene({0, 0});
  IrregularMesh broken = wall();
  broken.hierarchy.mesh.triangle[3][1] = 1'000'000;
  CHECK_THROWS_WITH(scene.insert(0, broken), "irregular mesh: triangle 3 has a corner that is no vertex");
}

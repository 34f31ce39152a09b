#include <tbb/global_control.h>
#include <tbb/parallel_invoke.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/acoustics/trace/testing/adapted.h"
#include "kernels/base/random/stream.h"

using namespace ensonify;
using namespace ensonify::trace;
using namespace ensonify::trace::adapted;
using frames::HeadPose;
using frames::Vec2;
using frames::Vec3;

namespace {

constexpr float kRange = 90.0F;

/// Nine tiles, 154 m to a side with posts every 0.1 m: dunes, and roughness from post to post.
const terrain::TileGrid kGrid{.origin_enu_m = {-76.8, -76.8}, .spacing_m = 0.1, .cells = 512};

double rough(double x, double y) {
  return -30.0 + 0.8 * std::sin(0.35 * x) * std::cos(0.21 * y) + 0.05 * std::sin(9.7 * x + 4.1 * y) * std::sin(7.3 * y);
}

Scene scene_of(const LevelOfDetail& detail, bool backwards = false) {
  Scene scene({0, 0}, detail);
  for (int i = 0; i < 9; ++i) {
    const int tile = backwards ? 8 - i : i;
    const terrain::TileKey key{tile % 3, tile / 3};
    scene.insert(key, terrain::sample_tile(kGrid, key, rough));
  }
  return scene;
}

const Scene& full() {
  static const Scene scene = scene_of({});
  return scene;
}

HeadPose pose(int ping) {
  const double heading = 0.4 + 0.11 * ping;
  return {{-10.0 + 0.9 * ping, 5.0 - 0.3 * ping, -5.0}, enu_from_body(frames::Attitude{heading, 0.03, -0.05})};
}

}  // namespace

TEST_CASE("main lobe rays hit bit-equal what they hit at full detail", "[long]") {
  Scene scene = scene_of({.enabled = true});
  std::size_t different = 0, side_lobes_differ = 0, missed = 0;
  for (int ping = 0; ping < 12; ++ping) {
    const auto found = ping_differences(full(), scene, pose(ping), kRange, rays_of(ping, 100'000, Lobes::kMain),
                                        rays_of(ping, 10'000, Lobes::kAll), {.head_m = 5.0, .bottom_m = 32.0});
    different += found.main_lobe;
    side_lobes_differ += found.all_round;
    for (const Hit hit : found.hits) missed += hit.hit() ? 0U : 1U;
  }
  CHECK(different == 0);
  CHECK(missed == 0);
  CHECK(side_lobes_differ > 10'000);  // they do see another mesh
}

TEST_CASE("no ray is lost between blocks, of one level or of two") {
  Scene scene = scene_of({.enabled = true});
  const random::Stream draws(5, "aims");
  std::size_t lost = 0, aimed = 0;
  for (int ping = 0; ping < 8; ++ping) {
    const HeadPose head = pose(ping);
    const Mesh mesh = scene.adapted(views_at(head, kRange));
    Rays rays;
    for (std::uint64_t i = 0; i < 250'000; ++i) {
      const auto k = static_cast<std::uint64_t>(ping);
      Vec2 at(140.0 * (draws.uniform(k, i, 0) - 0.5), 140.0 * (draws.uniform(k, i, 1) - 0.5));
      if (i % 4 != 0) {  // at a border of blocks, and as near to it as floats resolve
        const int axis = i % 2 == 0 ? 0 : 1;
        at[axis] = 3.2 * std::round(at[axis] / 3.2) + (i % 4 == 1 ? 1e-5 * draws.normal(k, i, 2) : 0.0);
      }
      const Vec3 to(at.x() - head.position_enu_m.x(), at.y() - head.position_enu_m.y(),
                    rough(at.x(), at.y()) - head.position_enu_m.z());
      rays.push_back({(head.enu_from_head.conjugate() * to.normalized()).cast<float>(), 1.0F});
    }
    Hits hits;
    mesh.trace(head, rays, 500.0F, hits);
    aimed += rays.size();
    for (const Hit hit : hits) lost += hit.hit() ? 0U : 1U;
  }
  CHECK(aimed == 2'000'000);
  CHECK(lost == 0);
}

TEST_CASE("the mesh of a ping does not depend on the way to it") {
  Scene wandering = scene_of({.enabled = true}), fresh = scene_of({.enabled = true}, true);
  for (int ping : {9, 0, 11, 3, 4}) wandering.adapted(views_at(pose(ping), kRange));
  CHECK(wandering.remove({2, 2}));
  wandering.insert({2, 2}, terrain::sample_tile(kGrid, {2, 2}, rough));
  const auto rays = rays_of(5, 100'000, Lobes::kAll);
  Hits a, b;
  wandering.adapted(views_at(pose(5), kRange)).trace(pose(5), rays, kRange, a);
  fresh.adapted(views_at(pose(5), kRange)).trace(pose(5), rays, kRange, b);
  CHECK(differences(a, b) == 0);
}

TEST_CASE("a mesh stays as it is while its scene is adapted to the next ping, and loses all its tiles") {
  Scene scene = scene_of({.enabled = true});
  const auto rays = rays_of(2, 20'000, Lobes::kAll);
  const Mesh mesh = scene.adapted(views_at(pose(2), kRange));
  Hits before, meanwhile, after;
  mesh.trace(pose(2), rays, kRange, before);
  tbb::parallel_invoke([&] { mesh.trace(pose(2), rays, kRange, meanwhile); },
                       [&] { scene.adapted(views_at(pose(9), kRange)); });
  for (int tile = 0; tile < 9; ++tile) CHECK(scene.remove({tile % 3, tile / 3}));
  scene = Scene({0, 0});
  mesh.trace(pose(2), rays, kRange, after);
  CHECK(before[0].hit());
  CHECK(differences(before, meanwhile) == 0);
  CHECK(differences(before, after) == 0);
  Mesh().trace(pose(2), rays, kRange, after);
  CHECK_FALSE(after[0].hit());
}

TEST_CASE("parts out of view are dropped after a while; none exist before an adaptation") {
  const Scene scene = scene_of({.enabled = true});
  CHECK(scene.triangles() == 0);
  scene.adapted(views_at(pose(0), kRange));
  const std::size_t triangles = scene.triangles();
  CHECK(triangles > 50'000);
  CHECK(triangles < 9UL * 2 * 512 * 512 / 8);
  for (int i = 0; i < 20; ++i) {  // away and back
    HeadPose away = pose(0);
    away.position_enu_m.x() += 500.0 + i;
    scene.adapted(views_at(away, kRange));
  }
  CHECK(scene.triangles() < triangles / 8);  // coarse ones stay
  scene.adapted(views_at(pose(0), kRange));
  CHECK(scene.triangles() >= triangles);
}

TEST_CASE("what no view intersects is built when a ray hits it, by any number of threads") {
  Scene scene = scene_of({.enabled = true}), other = scene_of({.enabled = true});
  const HeadPose head = pose(0);
  const Mesh mesh = scene.adapted(views_at(head, kRange)), another = other.adapted(views_at(head, kRange));
  const std::size_t in_view = scene.triangles();
  const random::Stream draws(17, "beyond");
  Rays rays;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const Vec2 at(150.0 * (draws.uniform(i, 0, 0) - 0.5), 150.0 * (draws.uniform(i, 1, 0) - 0.5));
    const Vec3 to(at.x() - head.position_enu_m.x(), at.y() - head.position_enu_m.y(), -25.0);
    rays.push_back({(head.enu_from_head.conjugate() * to.normalized()).cast<float>(), 1.0F});
  }
  Hits first, again, alone;
  mesh.trace(head, rays, 500.0F, first);
  const std::size_t with_others = scene.triangles();
  CHECK(with_others > in_view + 1000);
  mesh.trace(head, rays, 500.0F, again);
  CHECK(scene.triangles() == with_others);
  CHECK(differences(first, again) == 0);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  another.trace(head, rays, 500.0F, alone);
  CHECK(differences(first, alone) == 0);
  CHECK(other.triangles() == with_others);
}

TEST_CASE("50 m above posts of 0.1 m, held parts of a swath are 1/50 of the paged tiles") {
  // One tile's relief, repeated over the 21 tiles that a pager holds within 170 m (three depths and 20 m).
  const terrain::TileGrid grid{.origin_enu_m = {-51.2, -51.2}, .spacing_m = 0.1, .cells = 1024};
  const double turn = 2.0 * std::numbers::pi / 102.4;
  terrain::Tile tile = terrain::sample_tile(grid, {0, 0}, [&](double x, double y) {
    return -50.0 + std::sin(2 * turn * x) * std::cos(3 * turn * y) +
           0.1 * std::sin(150 * turn * x) * std::sin(90 * turn * y);
  });
  Scene scene({0, 0}, {.enabled = true});
  std::size_t paged = 0;
  for (int east = -2; east <= 2; ++east) {
    for (int north = -2; north <= 2; ++north) {
      const double nearest =
          std::hypot(102.4 * std::max(0.0, std::abs(east) - 0.5), 102.4 * std::max(0.0, std::abs(north) - 0.5));
      if (nearest > 170.0) continue;
      tile.origin_enu_m = grid.origin_of({east, north});
      scene.insert({east, north}, tile);
      paged += 2UL * 1024 * 1024;
    }
  }
  CHECK(scene.size() == 21);
  for (const double heading : {0.0, 0.5, 0.785}) {
    for (int ping = 0; ping < 10; ++ping) {
      const HeadPose head{{0.4 * ping * std::sin(heading), 0.4 * ping * std::cos(heading), -1.0},
                          enu_from_body(frames::Attitude{heading, 0, 0})};
      scene.adapted(views_of(kFan, head, 130.0, {}, 2));
      CAPTURE(heading, ping, scene.triangles());
      CHECK(50 * scene.triangles() <= paged);
    }
    for (int i = 0; i < 5; ++i) scene.adapted(std::array{lod::View{.frustum = {.max_range_m = 1.0 + i}}});
  }
}

#include "kernels/acoustics/trace/body.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "kernels/acoustics/trace/testing/sounding.h"
#include "kernels/water/refraction/thermocline.h"

using namespace ensonify;
using namespace ensonify::trace;
using namespace ensonify::trace::sounding;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using frames::Vec3;

namespace {

constexpr std::uint32_t kBall = 7;  // number
constexpr double kRadius_m = 0.25;
const Vec3 kMiddle(3.0, 0.2, -12.0);

Body body_of(const solids::Solid& solid, const Vec3& middle_enu_m, bool smooth, double sagitta_m = 1e-3) {
  Body body;
  body.surface = surface_of(solid, sagitta_m);
  body.surface.mesh.origin_enu_m = middle_enu_m;
  body.two_sided = !is_closed(solid);
  body.smooth = smooth;
  body.sediment = 4;
  body.instance = 31;
  body.label_class = 2;
  return body;
}

Body ball(bool smooth) { return body_of(solids::Sphere{2 * kRadius_m}, kMiddle, smooth); }

Sounding ping_at(const Scene& scene, double quality = 1.0) {
  const RaySettings settings{quality, 0.075};
  return trace_rays(scene, {mills_cross(), settings, random::Stream{1, "rays"}}, kHead,
                    Targets(scene.adapted(), 5e-3, 0.05));
}

std::size_t hits_of(const Sounding& ping, std::uint32_t contributor) {
  return static_cast<std::size_t>(std::ranges::count(ping.hits.contributor, contributor));
}

}  // namespace

TEST_CASE("a ray that hits a body says which, and the mesh's table what that is") {
  Scene scene = scene_of(flat);
  scene.insert_body(kBall, ball(false));
  Hits hits;
  const Rays rays{
      {(kHead.enu_from_head.conjugate() * (kMiddle - kHead.position_enu_m).normalized()).cast<float>(), 1.0F},
      {Eigen::Vector3f::UnitZ(), 1.0F}};
  const Mesh mesh = scene.adapted();
  mesh.trace(kHead, rays, kFar_m, hits);
  CHECK(hits.contributor[0] == body_contributor(kBall));
  CHECK_THAT(static_cast<double>(hits.range_m[0]),
             WithinAbs((kMiddle - kHead.position_enu_m).norm() - kRadius_m, 1.1e-3));
  CHECK(hits.contributor[1] == sediment_contributor(0));
  const Contributor& source = mesh.contributors()[by_path(hits.contributor[0], EchoPath::kViaSurface)];
  CHECK(source == Contributor{Contributor::Kind::kBody, 31, 2, 4, EchoPath::kViaSurface});
  CHECK((mesh.contributors()[body_contributor(kBall - 1)].kind == Contributor::Kind::kNoise));

  Hits behind;
  mesh.trace(kHead, rays, kFar_m, behind, 1500.0, body_contributor(kBall));
  CHECK(behind.contributor[0] == sediment_contributor(0));
  mesh.trace(kHead, rays, kFar_m, behind, 1500.0, kAllBodies);
  CHECK(behind.contributor[0] == sediment_contributor(0));

  CHECK(scene.remove_body(kBall));
  CHECK_FALSE(scene.remove_body(kBall));
  scene.adapted().trace(kHead, rays, kFar_m, hits);
  CHECK(hits.contributor[0] == sediment_contributor(0));
  mesh.trace(kHead, rays, kFar_m, hits);  // as it was
  CHECK(hits.contributor[0] == body_contributor(kBall));
}

TEST_CASE("rays to a ball that scatters at random stand for all of its lit surface") {
  Scene scene = scene_of(flat);
  scene.insert_body(kBall, ball(false));
  const Sounding ping = ping_at(scene);
  double lit_m2 = 0.0, lambert_m2 = 0.0;
  for (std::size_t i = 0; i < ping.rays.size(); ++i) {
    if (ping.hits.contributor[i] != body_contributor(kBall)) continue;
    const double per_m2 = static_cast<double>(ping.hits.tube_m2[i] * ping.rays.solid_angle_sr[i]);
    lit_m2 += per_m2 / static_cast<double>(ping.hits.sin_grazing[i]);
    lambert_m2 += per_m2 * static_cast<double>(ping.hits.sin_grazing[i]);
  }
  // The head sees less than half of it, down to the horizon of its place.
  const double away_m = (kMiddle - kHead.position_enu_m).norm();
  CHECK_THAT(lit_m2, WithinRel(2 * std::numbers::pi * kRadius_m * kRadius_m * (1.0 - kRadius_m / away_m), 0.005));
  double wanted_m2 = 0.0;  // of its facets
  const solids::Surface surface = ball(false).surface;
  for (std::size_t t = 0; t < surface.mesh.triangle.size(); ++t) {
    const auto corners = facet_of(surface, t).corners;
    const Vec3 across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double sine = across.normalized().dot((kHead.position_enu_m - corners[0]).normalized());
    if (sine > 0.0) wanted_m2 += 0.5 * across.norm() * sine * sine;
  }
  CHECK_THAT(lambert_m2, WithinRel(wanted_m2, 0.005));
}

TEST_CASE("a small body in the lobe has 64 rays at any quality") {
  Scene scene = scene_of(flat);
  scene.insert_body(kBall, body_of(solids::Box{{0.05, 0.05, 0.05}}, {-8.0, 0.2, -17.0}, false));
  for (const double quality : {0.05, 0.25, 1.0}) CHECK(hits_of(ping_at(scene, quality), body_contributor(kBall)) >= 60);
}

TEST_CASE("a smooth body has one ray to each part of its lit surface, and no other counts") {
  Scene scene = scene_of(flat);
  scene.insert_body(kBall, ball(true));
  const auto smooth = hits_of(ping_at(scene, 0.25), body_contributor(kBall));
  CHECK(hits_of(ping_at(scene, 4.0), body_contributor(kBall)) == smooth);
  CHECK(smooth > 200);
  const Mesh mesh = scene.adapted();
  CHECK(mesh.bodies().front().body->surface.mesh.triangle.size() / 2 - smooth < smooth / 4);
}

TEST_CASE("parts of a body that others hide do not count") {
  Scene scene = scene_of(flat);
  scene.insert_body(kBall, ball(true));
  const auto all = hits_of(ping_at(scene), body_contributor(kBall));
  // A wall to half way across the ball, 2 m nearer.
  scene.insert_body(kBall + 1,
                    body_of(solids::Box{{2.0, 3.0, 0.02}}, kMiddle * 10.0 / 12.0 + Vec3(1.0, 0.0, 0.0), false));
  const auto left = hits_of(ping_at(scene), body_contributor(kBall));
  CHECK(left > all / 3);
  CHECK(left < 2 * all / 3);
}

TEST_CASE("through bent water a body is hit as often") {
  Scene scene = scene_of(flat);
  scene.insert_body(kBall, ball(true));
  const auto water = refraction::summer_thermocline();
  refraction::PathTable table;
  const Mesh mesh = scene.adapted();
  mesh.tabulate(water, kHead, 1.0, kFar_m, table);
  const RaySettings settings{1.0, 0.075};
  const Sounding bent =
      trace_rays(scene, {mills_cross(), settings, random::Stream{1, "rays"}}, kHead, Targets(mesh, 5e-3, 0.05), &table);
  const auto straight = hits_of(ping_at(scene), body_contributor(kBall));
  CHECK(hits_of(bent, body_contributor(kBall)) > 0.98 * static_cast<double>(straight));
}

TEST_CASE("bodies with a fault are refused") {
  Scene scene({0, 0});
  Body body = ball(false);
  body.surface.bulge_m.pop_back();
  CHECK_THROWS_WITH(scene.insert_body(1, body), "body: there must be bulges of each triangle, or none");
  body = ball(false);
  body.surface.mesh.triangle[0] = {0, 1, 1'000'000};
  CHECK_THROWS_AS(scene.insert_body(1, body), std::invalid_argument);
}

TEST_CASE("behind all bodies lies the seabed, though one stands on it with a flat face and another in front") {
  Scene scene = scene_of(flat);
  const double ground_m = *scene.height_m({0.0, 0.0});
  Scene with = scene_of(flat);
  with.insert_body(3, body_of(solids::Box{{2.0, 2.0, 1.0}}, {0.0, 0.0, ground_m + 0.5}, false));
  with.insert_body(5, body_of(solids::Sphere{2.0}, {0.8, 0.0, ground_m + 3.0}, false));
  Rays rays;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 at(0.002 * (i - 500), 0.1, ground_m);
    rays.push_back({(kHead.enu_from_head.conjugate() * (at - kHead.position_enu_m).normalized()).cast<float>(), 1.0F});
  }
  Hits alone, first, behind;
  scene.adapted().trace(kHead, rays, kFar_m, alone);
  const Mesh mesh = with.adapted();
  mesh.trace(kHead, rays, kFar_m, first);
  mesh.trace(kHead, rays, kFar_m, behind, 1500.0, kAllBodies);
  CHECK(std::ranges::count(first.contributor, body_contributor(3)) > 0);
  CHECK(std::ranges::count(first.contributor, body_contributor(5)) > 0);
  CHECK(behind.contributor == alone.contributor);
  CHECK(behind.position_enu_m.x == alone.position_enu_m.x);
  CHECK(behind.range_m == alone.range_m);
}

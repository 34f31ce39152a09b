#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include "kernels/acoustics/trace/ray_distribution.h"
#include "kernels/acoustics/trace/testing/sounding.h"
#include "kernels/water/refraction/thermocline.h"

// Small things in empty water and above a seabed: rays find them wherever they are.

using namespace ensonify::trace;
using namespace ensonify::terrain;
using Catch::WithinAbs;
using ensonify::frames::HeadPose;
using ensonify::random::Stream;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kFar_m = 150.0;
constexpr int kCells = 24;  // of an object's tile, to a side

/// A body of facets about the middle of its own small tile: the upper half of a sphere, or a box as high as it is wide.
struct Boulder {
  double size_m, top_m;  // sphere: radius
  Vec2 middle;
  bool sphere;

  double spacing_m() const { return 2.2 * size_m / kCells; }
  void insert(Scene& scene) const {
    const double spacing_m = this->spacing_m();
    Tile tile{.origin_enu_m = middle - Vec2::Constant(0.5 * kCells * spacing_m),
              .spacing_m = spacing_m,
              .columns = kCells + 1,
              .rows = kCells + 1,
              .height_m = std::vector<float>((kCells + 1) * (kCells + 1))};
    for (int y = 0; y <= kCells; ++y) {
      for (int x = 0; x <= kCells; ++x) {
        const Vec2 off = spacing_m * (Vec2(x, y) - Vec2::Constant(0.5 * kCells));
        const double d = off.norm() / size_m, side = off.cwiseAbs().maxCoeff() / size_m;
        const double fall = sphere ? 1.0 - std::sqrt(1.0 - d * d) : side <= 1.0 ? 0.0 : 1.0;  // NaN beyond the rim
        tile.height_m[tile.post(x, y)] = static_cast<float>(top_m - fall * size_m);
      }
    }
    scene.insert({1000, 1000}, tile);
  }

  /// Of its tile's triangles.
  std::size_t facet(const Hit& hit) const {
    const Vec2 at = (hit.position_enu_m.head<2>() - middle) / spacing_m() + Vec2::Constant(0.5 * kCells);
    const Vec2 cell = at.array().floor().min(kCells - 1.0).max(0.0), inside = at - cell;
    const bool upper = inside.x() + inside.y() > 1;  // Embree cuts from north-west to south-east
    return static_cast<std::size_t>(2 * (cell.y() * kCells + cell.x()) + upper);
  }
};

struct View {
  HeadPose head;
  TransmitVolume volume;
  std::function<bool(const Ray&)> main_lobe;
};

/// 1 degree x 130 degrees, level.
View multibeam() {
  return {{{0.1, 0.2, 0.0}, ensonify::frames::enu_from_ned()},
          mills_cross_volume(50, 50, 67.5 * kDegree),
          [](const Ray& ray) {
            return std::abs(ray.direction_head.x()) < 1.0F / 50 &&
                   std::abs(std::atan2(ray.direction_head.y(), ray.direction_head.z())) < 65 * kDegree;
          }};
}

/// 120 x 20 degrees ahead, tilted down by 30.
View forward_looking() {
  const double half = std::sin(10 * kDegree);
  return {{{0.1, 0.2, 0.0}, enu_from_body(ensonify::frames::Attitude{0, -30 * kDegree, 0})},
          {TransmitVolume::Axis::kDown,
           {-half, half, -half, half, 2 * half},
           {-60 * kDegree, 60 * kDegree, -60 * kDegree, 60 * kDegree, 1 * kDegree}},
          [](const Ray&) { return true; }};
}

Hits view_from(const Scene& scene, const View& view, std::uint64_t draw, Rays& rays) {
  RayDistribution distribution(view.volume, {RaySettings::kNormal, 0.3}, Stream{draw, "rays"});
  sounding::Sounding traced = sounding::trace_rays(scene, distribution, view.head, scene.objects());
  rays = std::move(traced.rays);
  return std::move(traced.hits);
}

/// Somewhere in the middle of the main lobe, 2 m away to the farthest.
Boulder body_in(const View& view, double farthest_m, std::uint64_t k) {
  const Stream place{k, "place"};
  const Span &u = view.volume.sine, &phi = view.volume.angle_rad;
  const double sine = 0.8 * (u.main_low + (u.main_high - u.main_low) * place.uniform(0));
  const double angle = 0.9 * (phi.main_low + (phi.main_high - phi.main_low) * place.uniform(1));
  const double side = std::sqrt(1 - sine * sine) * std::sin(angle), zero = std::sqrt(1 - sine * sine) * std::cos(angle);
  const bool forward = view.volume.axis == TransmitVolume::Axis::kForward;
  const Vec3 d = view.head.enu_from_head * (forward ? Vec3(sine, side, zero) : Vec3(zero, side, sine));
  const Vec3 at = view.head.position_enu_m + 2.0 * std::pow(0.5 * farthest_m, place.uniform(2)) * d;
  return {0.05 * std::pow(10.0, place.uniform(3)), at.z(), at.head<2>(), k % 2 == 0};
}

/// Hits of each facet of a body.
struct Seen {
  std::vector<int> hits = std::vector<int>(2 * kCells * kCells);

  void count(const Scene& scene, const View& view, const Boulder& body, std::uint64_t draw, bool in_main_lobe) {
    Rays rays;
    const auto found = view_from(scene, view, draw, rays);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!found[i].hit() || found[i].facet_m != static_cast<float>(body.spacing_m())) continue;
      if (!in_main_lobe || view.main_lobe(rays[i])) ++hits[body.facet(found[i])];
    }
  }
};

/// 60 m down, in 1 m posts.
Scene seabed() {
  Scene scene({0, 0});
  scene.insert({0, 0}, sample_tile({.origin_enu_m = {-200, -200}, .spacing_m = 1.0, .cells = 400}, {0, 0},
                                   [](double x, double y) { return -60 + std::sin(0.2 * x) + std::cos(0.3 * y); }));
  return scene;
}

}  // namespace

TEST_CASE("small spheres and boxes are hit wherever they are, and so are all their facets", "[long]") {
  // 0.1 to 1 m wide, 2 to 100 m away, above the seabed to 50 m: 18 bodies, seen from outside. What 16 draws find at
  // least 4 times, one draw finds, but for 1 in 1000. Over five draws it is 1 in 1600: slivers of facets that another
  // hides, or the volume's edge cuts.
  int found = 0, unhit = 0, missed = 0;
  for (const View& view : {multibeam(), forward_looking()}) {
    for (const bool over_seabed : {false, true}) {
      Scene scene = over_seabed ? seabed() : Scene({0, 0});
      for (std::uint64_t k = 0; k < (over_seabed ? 3 : 6); ++k) {
        const Boulder body = body_in(view, over_seabed ? 50.0 : 100.0, k);
        body.insert(scene);
        Seen once, sixteen;
        once.count(scene, view, body, 0, false);
        for (std::uint64_t draw = 1; draw <= 16; ++draw) sixteen.count(scene, view, body, draw, true);
        missed += std::all_of(once.hits.begin(), once.hits.end(), [](int n) { return n == 0; });
        for (std::size_t f = 0; f < once.hits.size(); ++f) {
          found += sixteen.hits[f] >= 4, unhit += sixteen.hits[f] >= 4 && once.hits[f] == 0;
        }
      }
    }
  }
  CAPTURE(found, unhit);
  CHECK(missed == 0);
  CHECK(found > 11'000);
  CHECK(unhit <= 1e-3 * found);
}

TEST_CASE("an object takes the rays its facets need; others keep the volume's solid angle") {
  const View view = multibeam();
  const Boulder body{0.15, -30.0, {25.0, 0.25}, true};
  Scene scene({0, 0});
  Rays rays;
  const std::size_t none = (view_from(scene, view, 1, rays), rays.size());
  body.insert(scene);
  const auto hits = view_from(scene, view, 1, rays);
  double sum = 0.0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i].hit()) sum += rays[i].solid_angle_sr;
  }
  CHECK(sum == Approx(2 * 8.0 / 50 * 2 * 67.5 * kDegree).epsilon(1e-5));
  // A head sees half of the half sphere's facets and more: 16 rays to each of them, and as many to those in its shade.
  const double facets = 2.0 * std::numbers::pi * std::pow(body.size_m / body.spacing_m(), 2);
  const auto on_it = std::ranges::count_if(hits.range_m, [](float range_m) { return range_m > 0.0F; });
  CHECK(double(on_it) > 0.5 * 16 * facets);
  CHECK(double(on_it) < 1.1 * 16 * facets);
  CHECK(double(rays.size() - none) < 2.5 * double(on_it));
}

namespace {

/// What an object sends back by Lambert's law, and the solid angle that it covers.
struct Answer {
  double energy = 0.0, solid_angle_sr = 0.0;
};

/// Of the hits on it, mean over draws.
Answer answer(const Scene& scene, const View& view, const Boulder& body, double quality, bool by_facets, int draws,
              const ensonify::refraction::PathTable* water = nullptr) {
  Answer sum;
  for (int draw = 0; draw < draws; ++draw) {
    RayDistribution distribution(view.volume, {quality, 0.3}, Stream{static_cast<std::uint64_t>(draw), "rays"});
    const auto [rays, hits, share] = sounding::trace_rays(
        scene, distribution, view.head, by_facets ? scene.objects() : std::span<const Object>{}, water);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (!hits[i].hit() || hits[i].facet_m != static_cast<float>(body.spacing_m())) continue;
      sum.energy += double(rays[i].solid_angle_sr * hits[i].sin_grazing) / draws;
      sum.solid_angle_sr += double(rays[i].solid_angle_sr) / draws;
    }
  }
  return sum;
}

double db(double ratio) { return 10.0 * std::log10(ratio); }

/// Warm water over cold, from the head 2 m deep down to 10 m.
ensonify::refraction::PathTable summer(const Scene& scene, const HeadPose& head) {
  ensonify::refraction::PathTable paths;
  scene.adapted().tabulate(ensonify::refraction::summer_thermocline(), head, 2.0, kFar_m, paths);
  return paths;
}

}  // namespace

TEST_CASE("a body answers with the level that evenly spread rays give, and covers as much", "[long]") {
  // In front of a near seabed that gets rays enough: 12,000 on the body and more, so 0.05 dB of chance; allowed 0.2 dB.
  const View view = forward_looking();
  for (const bool sphere : {true, false}) {
    Scene scene = seabed();
    const Boulder body{0.8, -4.0, {0.5, 7.0}, sphere};
    body.insert(scene);
    const Answer facets = answer(scene, view, body, 1.0, true, 1), even = answer(scene, view, body, 4.0, false, 4);
    INFO((sphere ? "sphere " : "box ") << db(facets.energy / even.energy) << " dB");
    CHECK(even.energy > 0.0);
    CHECK_THAT(db(facets.energy / even.energy), WithinAbs(0.0, 0.2));
    CHECK_THAT(db(facets.solid_angle_sr / even.solid_angle_sr), WithinAbs(0.0, 0.2));
  }
}

TEST_CASE("half a sphere straight below covers the solid angle of its disc") {
  const View view{{{0.0, 0.0, 0.0}, ensonify::frames::enu_from_ned()},
                  mills_cross_volume(5, 5, 67.5 * kDegree),
                  [](const Ray&) { return true; }};
  const Boulder body{0.3, -20.0, {0.0, 0.0}, true};
  Scene scene({0, 0});
  body.insert(scene);
  // Its outline is the rim of the cells that are whole: count them. It lies 0.2 m below the top at 20 m.
  int cells = 0;
  for (int y = 0; y < kCells; ++y) {
    for (int x = 0; x < kCells; ++x) {
      const Vec2 outer = (Vec2(x + 0.5, y + 0.5) - Vec2::Constant(0.5 * kCells)).cwiseAbs() + Vec2::Constant(0.5);
      cells += body.spacing_m() * outer.norm() < body.size_m;
    }
  }
  const double disc_sr = cells * std::pow(body.spacing_m(), 2) / (20.2 * 20.2);
  CHECK(answer(scene, view, body, 1.0, true, 1).solid_angle_sr == Approx(disc_sr).epsilon(0.01));
}

TEST_CASE("refracted rays find a small body in place, and all facets straight ones find") {
  // 80 m ahead below a thermocline a path is metres off the straight line.
  const HeadPose head{{0.0, 0.0, -2.0}, enu_from_body(ensonify::frames::Attitude{0, -20 * kDegree, 0})};
  View view = forward_looking();
  view.head = head;
  const Vec3 ahead = head.enu_from_head * Vec3(1, 0, 0);
  const Boulder body{0.3, -2.0 + 70.0 * ahead.z(), 70.0 * ahead.head<2>(), true};
  Scene scene({0, 0});
  body.insert(scene);
  const auto water = summer(scene, head);
  const Answer refracted = answer(scene, view, body, 1.0, true, 1, &water),
               straight = answer(scene, view, body, 1.0, true, 1);
  // Sound spreads otherwise, and comes from a little above: nothing like a body that is missed or half seen.
  INFO("bent " << refracted.solid_angle_sr << " sr, straight " << straight.solid_angle_sr << " sr");
  CHECK_THAT(db(refracted.solid_angle_sr / straight.solid_angle_sr), WithinAbs(0.0, 1.0));
}

TEST_CASE("of a scanned coral's facets few are unhit") {
  const char* shared = std::getenv("ENSONIFY_SHARED");
  std::ifstream file(std::string(shared == nullptr ? "../shared" : shared) + "/data/objects/mcap_coral.obj");
  if (!file) {
    WARN("no coral in the shared data; skipped");
    return;
  }
  // The highest of its points in each cell of 1 cm, one coral after the scan in its own scale, 0.4 m wide.
  const double spacing_m = 0.01;
  Tile tile{.origin_enu_m = {0.0, 8.0},
            .spacing_m = spacing_m,
            .columns = 60,
            .rows = 60,
            .height_m = std::vector<float>(3600, std::numeric_limits<float>::quiet_NaN())};
  double x = 0, y = 0, z = 0;
  for (std::string kind, rest; file >> kind; std::getline(file, rest)) {
    if (kind != "v" || !(file >> x >> y >> z)) continue;
    const int column = static_cast<int>(x / spacing_m) + 10, row = static_cast<int>(y / spacing_m) + 10;
    if (column < 0 || row < 0 || column >= 60 || row >= 60) continue;
    float& post = tile.height_m[tile.post(column, row)];
    post = std::isnan(post) ? static_cast<float>(z - 4.6) : std::max(post, static_cast<float>(z - 4.6));
  }
  Scene scene({0, 0});
  scene.insert({0, 0}, tile);
  const View view = forward_looking();
  const auto seen = [&](std::uint64_t draw, std::vector<int>& hits) {
    Rays rays;
    for (const Hit& hit : view_from(scene, view, draw, rays)) {
      if (!hit.hit()) continue;
      const Vec2 at = (hit.position_enu_m.head<2>() - tile.origin_enu_m) / spacing_m;
      const Vec2 cell = at.array().floor(), inside = at - cell;
      ++hits[static_cast<std::size_t>(2 * (cell.y() * 60 + cell.x()) + (inside.sum() > 1))];
    }
  };
  std::vector<int> once(7200), sixteen(7200);
  seen(0, once);
  for (std::uint64_t draw = 1; draw <= 16; ++draw) seen(draw, sixteen);
  int found = 0, unhit = 0, whole = 0, whole_unhit = 0;
  for (std::size_t f = 0; f < once.size(); ++f) {
    found += sixteen[f] >= 4, unhit += sixteen[f] >= 4 && once[f] == 0;
    whole += sixteen[f] >= 32, whole_unhit += sixteen[f] >= 32 && once[f] == 0;
  }
  // Facets half and more of which are seen; those of which a sliver shows behind another are found at times.
  CAPTURE(found, unhit, whole, whole_unhit);
  CHECK(whole > 500);
  CHECK(whole_unhit <= 5e-3 * whole);
}

TEST_CASE("seabed is no object; small tiles are, and so is what stands among holes") {
  Scene scene({0, 0});
  const auto level = [](double, double) { return -20.0; };
  scene.insert({0, 0}, sample_tile({.origin_enu_m = {-50, -50}, .spacing_m = 0.5, .cells = 100}, {0, 0}, level));
  CHECK(scene.objects().empty());
  scene.insert({1, 0}, sample_tile({.origin_enu_m = {100, 0}, .spacing_m = 0.1, .cells = 20}, {0, 0}, level));
  REQUIRE(scene.objects().size() == 1);
  CHECK(scene.objects()[0].tile->spacing_m == 0.1);
  CHECK(scene.objects()[0].end_column == 20);
  CHECK(scene.objects()[0].box_enu_m.min().isApprox(Vec3(100, 0, -20)));
  CHECK(scene.objects()[0].box_enu_m.max().isApprox(Vec3(102, 2, -20)));
  // A box of 4 m in a tile that is a hole all around: in four blocks of 16 cells, together as large as it is.
  scene.insert({2, 0},
               sample_tile({.origin_enu_m = {200, 0}, .spacing_m = 0.25, .cells = 100}, {0, 0}, [](double x, double y) {
                 const bool on = std::abs(x - 208) < 2.01 && std::abs(y - 8) < 2.01;
                 return on ? -15.0 : std::numeric_limits<double>::quiet_NaN();
               }));
  REQUIRE(scene.objects().size() == 5);
  Eigen::AlignedBox3d all;
  for (const Object& object : scene.objects().subspan(1)) all.extend(object.box_enu_m);
  CHECK(all.min().isApprox(Vec3(206, 6, -15)));
  CHECK(all.max().isApprox(Vec3(210, 10, -15)));
  scene.remove({2, 0});
  CHECK(scene.objects().size() == 1);
}

#include "kernels/trace/ray_distribution.h"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <set>

#include "kernels/relief/bodies.h"
#include "kernels/relief/spectral_surface.h"

using namespace ensonify::trace;
using namespace ensonify::terrain;
using ensonify::frames::HeadPose;
using ensonify::random::Stream;

static constexpr double kDegree = std::numbers::pi / 180.0;
static constexpr float kFar_m = 150.0F;
static constexpr double kNull = 1.0 / 50;  // sine of the first null of 50 wavelengths
static constexpr double kSwath_rad = 65 * kDegree;
static constexpr double kDepth_m = 20.0;
/// Level, to the north, where no post is.
static const HeadPose kHead{{0.1, 0.2, 0.0}, ensonify::frames::enu_from_ned()};

/// A head of 1 degree x 1 degree, with rays 2.5 degrees beyond its outermost beam as heads have them.
static TransmitVolume mills_cross() { return mills_cross_volume(50, 50, kSwath_rad + 2.5 * kDegree); }

static double flat(double, double) { return -kDepth_m; }

struct Sounding {
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  double share = 1.0;
};

static Sounding sound(const Scene& scene, const RaySettings& settings, std::uint64_t seed = 1,
                      const HeadPose& head = kHead, const TransmitVolume& volume = mills_cross()) {
  RayDistribution distribution(volume, settings, Stream{seed, "rays"});
  Sounding s;
  scene.trace(head, distribution.probes(), kFar_m, s.hits);
  distribution.fill(head, s.hits, scene.objects(), kFar_m, s.rays);
  scene.trace(head, s.rays, kFar_m, s.hits);
  distribution.settle(s.rays, s.hits);
  s.share = distribution.share();
  return s;
}

static Scene scene_of(const std::function<double(double, double)>& height, double spacing_m = 0.25, int cells = 800) {
  Scene scene({0, 0});
  const double corner = -0.5 * cells * spacing_m;
  scene.insert({0, 0},
               sample_tile({.origin_enu_m = {corner, corner}, .spacing_m = spacing_m, .cells = cells}, {0, 0}, height));
  return scene;
}

static double across_rad(const Ray& ray) { return std::atan2(ray.direction_head.y(), ray.direction_head.z()); }

TEST_CASE("the solid angles of a distribution sum to that of its volume, whatever it sees") {
  const Scene seabed = scene_of([](double x, double y) { return -20 + std::sin(x) + std::cos(2 * y); }, 0.5, 200);
  for (const double quality : {RaySettings::kPreview, RaySettings::kNormal}) {
    double sum = 0;
    for (const Ray& ray : sound(seabed, {quality, 0.075}).rays) {
      sum += ray.solid_angle_sr;
      REQUIRE(ray.direction_head.norm() == Approx(1).margin(1e-6));
    }
    CHECK(sum == Approx(2 * 8.0 / 50 * 2 * 67.5 * kDegree).epsilon(1e-5));  // du dphi
  }
  CHECK(sound(Scene({0, 0}), {}).rays.size() >= 1024);  // nothing to see: one ray per cell
}

TEST_CASE("rays lie in the volume, about either axis of the head") {
  const TransmitVolume ahead{TransmitVolume::Axis::kDown,
                             {-0.1, 0.3, -0.1, 0.3, 0.4},
                             {-60 * kDegree, 20 * kDegree, -60 * kDegree, 20 * kDegree, 1 * kDegree}};
  const HeadPose tilted{{0, 0, 0}, enu_from_body(ensonify::frames::Attitude{0, -0.3, 0})};
  double sum = 0;
  float lowest = 1, highest = -1, port = 0, starboard = 0;
  for (const Ray& ray : sound(scene_of(flat, 0.5, 400), {RaySettings::kPreview, 0.1}, 1, tilted, ahead).rays) {
    sum += ray.solid_angle_sr;
    const float azimuth = std::atan2(ray.direction_head.y(), ray.direction_head.x());
    lowest = std::min(lowest, ray.direction_head.z()), highest = std::max(highest, ray.direction_head.z());
    port = std::min(port, azimuth), starboard = std::max(starboard, azimuth);
  }
  CHECK(sum == Approx(0.4 * 80 * kDegree).epsilon(1e-5));
  CHECK(lowest == Approx(-0.1).margin(0.01));
  CHECK(highest == Approx(0.3).margin(0.01));
  CHECK(port == Approx(-60 * kDegree).margin(0.01));
  CHECK(starboard == Approx(20 * kDegree).margin(0.01));
}

/// Below which relief is smooth: four posts, or less than one.
static constexpr double kFourPosts_m = 1.0, kRough_m = 0.1;

/// Relief of 0.3 m rms and some 200 boulders per hectare.
static Scene strewn_with_boulders(std::uint64_t seed, double spacing_m, int cells,
                                  double smooth_below_m = kFourPosts_m) {
  const ensonify::relief::Bodies boulders(
      {.per_km2 = 20000, .smallest_radius_m = 0.5, .largest_radius_m = 2.0, .size_exponent = 1.0}, spacing_m, seed,
      "boulders");
  const ensonify::relief::SpectralSurface relief({.rms_m = 0.3, .outer_scale_m = 40.0, .inner_scale_m = smooth_below_m},
                                                 spacing_m, seed, "relief");
  const ensonify::relief::Window posts{0, -cells / 2, -cells / 2, cells + 1, cells + 1};
  std::vector<float> body_m(posts.size()), relief_m(posts.size());
  boulders.fill(posts, body_m);
  relief.fill(posts, relief_m);
  return scene_of(
      [&](double x, double y) {
        const auto k = posts.node(static_cast<int>(std::lround(x / spacing_m) - posts.east),
                                  static_cast<int>(std::lround(y / spacing_m) - posts.north));
        return -kDepth_m + static_cast<double>(body_m[k]) + static_cast<double>(relief_m[k]);
      },
      spacing_m, cells);
}

/// Facets that 16 draws hit at least 4 times in the main lobe, and those of them that one draw misses, of four seabeds.
struct Facets {
  int found = 0, unhit = 0;
};
static Facets facets(double smooth_below_m, double quality) {
  constexpr double kSpacing_m = 0.25;
  constexpr int kCells = 400;
  Facets facets;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Scene scene = strewn_with_boulders(seed, kSpacing_m, kCells, smooth_below_m);
    const auto count = [&](std::uint64_t draw, bool in_main_lobe, std::vector<int>& hits_of_facet) {
      const Sounding s = sound(scene, {quality, 0.075}, draw);
      for (std::size_t k = 0; k < s.hits.size(); ++k) {
        const Ray& ray = s.rays[k];
        const bool main = std::abs(ray.direction_head.x()) < kNull && std::abs(across_rad(ray)) < kSwath_rad;
        if (!s.hits[k].hit() || (in_main_lobe && !main)) continue;
        const Vec2 at = s.hits[k].position_enu_m.head<2>() / kSpacing_m + Vec2(0.5 * kCells, 0.5 * kCells);
        const Vec2 cell = at.array().floor(), inside = at - cell;
        const bool upper = inside.x() + inside.y() > 1;  // Embree cuts from north-west to south-east
        ++hits_of_facet[static_cast<std::size_t>(2 * (cell.y() * kCells + cell.x()) + upper)];
      }
    };
    std::vector<int> once(2 * kCells * kCells), sixteen(2 * kCells * kCells);
    count(0, false, once);
    for (std::uint64_t draw = 1; draw <= 16; ++draw) count(draw, true, sixteen);
    for (std::size_t f = 0; f < once.size(); ++f) {
      facets.found += sixteen[f] >= 4;
      facets.unhit += sixteen[f] >= 4 && once[f] == 0;
    }
  }
  return facets;
}

TEST_CASE("of the facets that 16 times the rays hit at least 4 times in the main lobe at most 0.1 % are unhit") {
  // Shadows, silhouettes and facets seen edge-on. Four seabeds have 15,000 facets in the main lobe, so the limit is 15
  // of them. At normal quality where relief is smooth below four posts; where it is rough down to its posts, with three
  // times the rays, for what is seen nearly edge-on is missed by chance, as exp(-rays).
  const auto check = [](double smooth_below_m, double quality, double allowed = 1e-3) {
    const Facets of = facets(smooth_below_m, quality);
    CAPTURE(of.found, of.unhit);
    CHECK(of.found > 10'000);
    CHECK(of.unhit <= allowed * of.found);
  };
  check(kFourPosts_m, RaySettings::kNormal);
  check(kRough_m, 3.0);
  check(kFourPosts_m, RaySettings::kPreview, 0.04);  // a preview leaves 3.0 and 3.6 %
  check(kRough_m, RaySettings::kPreview, 0.04);
}

TEST_CASE("rays for the picture", "[.rays-csv]") {
  const Sounding s = sound(strewn_with_boulders(1, 0.25, 400), {RaySettings::kNormal, 0.075});
  std::puts("sine,across_deg,range_m,east_m,north_m,up_m");
  for (std::size_t k = 0; k < s.hits.size(); ++k) {
    const auto& at = s.hits[k].position_enu_m;
    if (!s.hits[k].hit()) continue;
    std::printf("%.5f,%.3f,%.3f,%.3f,%.3f,%.3f\n", static_cast<double>(s.rays[k].direction_head.x()),
                across_rad(s.rays[k]) / kDegree, static_cast<double>(s.hits[k].range_m), at.x(), at.y(), at.z());
  }
}

/// Rays in each resolution cell (range x beam of 1 degree) of a head over a plane: fewest, and mean.
struct Contributions {
  int fewest = 1 << 30;
  double mean = 0.0;
};
static Contributions contributions(const Sounding& s, double resolution_m, int beams) {
  constexpr double kTenthPower = 0.738;  // sinc^2 is -10 dB at 0.738 lambda / L
  Contributions c;
  int cells = 0;
  for (int b = 0; b < beams; ++b) {
    const double axis = kSwath_rad * (2.0 * b / (beams - 1) - 1.0), half = std::asin(kTenthPower * kNull);
    const double low = std::max(0.0, std::abs(axis) - half), high = std::abs(axis) + half;
    // Whole range cells within the beam; near nadir a beam is within one range cell.
    const double first = kDepth_m / std::cos(low), last = kDepth_m / std::cos(high);
    const int ranges = std::max(1, static_cast<int>((last - first) / resolution_m));
    std::vector<int> count(static_cast<std::size_t>(ranges));
    for (std::size_t k = 0; k < s.hits.size(); ++k) {
      if (!s.hits[k].hit() || std::abs(s.rays[k].direction_head.x()) > kTenthPower * kNull) continue;
      if (std::abs(across_rad(s.rays[k]) - axis) > half) continue;
      const int range = static_cast<int>((s.hits[k].range_m - first) / resolution_m);
      if (range >= 0 && range < ranges) ++count[static_cast<std::size_t>(range)];
    }
    for (const int n : count) {
      c.fewest = std::min(c.fewest, n);
      c.mean += n;
      ++cells;
    }
  }
  c.mean /= cells;
  return c;
}

TEST_CASE("every resolution cell within -10 dB gets at least 10 contributions") {
  const Scene scene = scene_of(flat);
  for (const double resolution_m : {0.02, 0.075, 0.3}) {
    const Sounding s = sound(scene, {RaySettings::kNormal, resolution_m});
    const Contributions c = contributions(s, resolution_m, 131);
    CAPTURE(resolution_m, s.rays.size(), c.mean);
    CHECK(c.fewest >= 10);
  }
}

TEST_CASE("the mean level of a plane is that of the area integral, whatever the quality") {
  // Lambert's law, sigma = sin^2: a ray sends back source sigma dOmega / sin, and r^2 thins it on the way. With
  // sin = b cos(phi), r = H / sin and b = sqrt(1 - u^2), the integral over 10 degrees of phi is a product. Preview has
  // 1000 rays or more in ten degrees. Within a stratum their contributions vary by some 30 %, so the sum does by 1 %,
  // or 0.04 dB: the limit is two and a half standard deviations at preview, five at normal, ten at reference.
  const Scene scene = scene_of(flat);
  const auto pattern = [](double u) {
    const double x = std::numbers::pi * 50 * u;
    return x == 0 ? 1.0 : std::pow(std::sin(x) / x, 2);
  };
  double over_u = 0;
  constexpr int kSteps = 20'000;
  for (int i = 0; i < kSteps; ++i) {
    const double u = 8.0 / 50 * ((2 * i + 1.0) / kSteps - 1);
    over_u += pattern(u) * std::pow(1 - u * u, 1.5) * 16.0 / 50 / kSteps;
  }
  for (const double quality : {RaySettings::kPreview, RaySettings::kNormal, RaySettings::kReference}) {
    const Sounding s = sound(scene, {quality, 0.075});
    std::vector<double> level(12);
    for (std::size_t k = 0; k < s.hits.size(); ++k) {
      const int sector = static_cast<int>(std::floor(across_rad(s.rays[k]) / (10 * kDegree))) + 6;
      if (sector < 0 || sector >= 12) continue;
      level[static_cast<std::size_t>(sector)] += pattern(s.rays[k].direction_head.x()) * s.rays[k].solid_angle_sr *
                                                 s.hits[k].sin_grazing / std::pow(s.hits[k].range_m, 2);
    }
    for (int sector = 0; sector < 12; ++sector) {
      const auto to = [](double phi) { return std::sin(phi) - std::pow(std::sin(phi), 3) / 3; };
      const double exact =
          over_u / (kDepth_m * kDepth_m) * (to((sector - 5) * 10 * kDegree) - to((sector - 6) * 10 * kDegree));
      CAPTURE(sector, s.rays.size());
      CHECK(10 * std::log10(level[static_cast<std::size_t>(sector)] / exact) == Approx(0).margin(0.1));
    }
  }
}

/// Of the main-lobe hits of `there`, the share that lies within 1 cm of a hit of `here`, on the horizontal.
static double found_again(const Sounding& here, const Sounding& there) {
  constexpr double kNear_m = 0.01;
  std::set<std::pair<long, long>> near;
  for (const Hit& hit : here.hits) {
    const Vec2 cell = hit.position_enu_m.head<2>() / kNear_m;
    for (const long x : {-1, 0, 1}) {
      for (const long y : {-1, 0, 1}) near.emplace(std::lround(cell.x()) + x, std::lround(cell.y()) + y);
    }
  }
  double again = 0, all = 0;
  for (std::size_t k = 0; k < there.hits.size(); ++k) {
    if (!there.hits[k].hit() || std::abs(there.rays[k].direction_head.x()) > kNull) continue;
    const Vec2 cell = there.hits[k].position_enu_m.head<2>() / kNear_m;
    ++all;
    again += double(near.count({std::lround(cell.x()), std::lround(cell.y())}));
  }
  return again / all;
}

TEST_CASE("a head that moved has rays to the places where they went before") {
  // 5 cm forward, heave, and a little of each rotation: a tenth of what is seen is new. Places that rays aim at lie on
  // planes a quarter of a metre apart and wander a little on relief. What another seed finds again is chance.
  const HeadPose moved{kHead.position_enu_m + Vec3(0.004, 0.05, 0.01),
                       kHead.enu_from_head * enu_from_body(ensonify::frames::Attitude{0.003, -0.002, 0.003}) *
                           enu_from_body(ensonify::frames::Attitude{}).conjugate()};
  for (const double quality : {RaySettings::kPreview, RaySettings::kNormal}) {
    const auto shares = [&](const Scene& scene) {
      return found_again(sound(scene, {quality, 0.075}), sound(scene, {quality, 0.075}, 1, moved));
    };
    const double level = shares(scene_of(flat)), relief = shares(strewn_with_boulders(1, 0.25, 400));
    const Scene plane = scene_of(flat);
    const double chance = found_again(sound(plane, {quality, 0.075}), sound(plane, {quality, 0.075}, 2, moved));
    CAPTURE(quality, level, relief, chance);
    CHECK(chance < 0.5);
    const bool preview = quality < 1.0;  // cells near nadir have too few rays to aim at places
    CHECK(level > (preview ? 0.6 : 0.85));
    CHECK(relief > (preview ? 0.5 : 0.65));
  }
}

TEST_CASE("what is behind a crest is in its shadow, to the crest's line of sight") {
  // A crest 5 m high along north at x = 10 m, 0.25 m wide at its foot. From 20 m above the seabed at x = 0.1 m its
  // shadow ends at 0.1 + 9.9 * 20 / 15 = 13.3 m.
  const Scene scene = scene_of([](double x, double) { return std::abs(x - 10) < 0.1 ? -15.0 : -20.0; });
  const Sounding s = sound(scene, {RaySettings::kNormal, 0.075});
  double first_behind_m = 100;
  int on_crest = 0;
  for (const Hit& hit : s.hits) {
    const double x = hit.position_enu_m.x();
    on_crest += x > 9.75 && x < 10.001;
    if (x > 10.001) first_behind_m = std::min(first_behind_m, x);
  }
  const double cell_m = 0.075 / std::sin(std::atan2(13.2, 20.0));  // of the range resolution, on the seabed
  CHECK(first_behind_m > 13.3 - 1e-3);
  CHECK(first_behind_m < 13.3 + cell_m);
  // From crest to foot ranges go from 18.0 to 22.2 m: 56 range cells, 2.26 beams within the main lobe, 12 rays each.
  CHECK(on_crest > 56 * 2.26 * 12);
}

TEST_CASE("rays follow range cells, not beams") {
  const Scene scene = scene_of(flat, 2.0, 100);  // few facets, so range cells decide
  const auto rays = [&](double resolution_m, double receive_waves) {
    const auto volume = mills_cross_volume(50, receive_waves, kSwath_rad);
    return static_cast<double>(sound(scene, {RaySettings::kNormal, resolution_m}, 1, kHead, volume).rays.size());
  };
  // Twice the range cells, twice the rays, but near nadir, where a beam is within one range cell.
  CHECK(rays(0.005, 50) / rays(0.01, 50) == Approx(2).epsilon(0.1));
  // Narrower receive beams cut the seabed finer near nadir only.
  CHECK(rays(0.01, 100) / rays(0.01, 50) == Approx(1).epsilon(0.1));
  CHECK(rays(0.01, 100) > rays(0.01, 50));
}

TEST_CASE("a steered volume has the same solid angles elsewhere, and what is beyond endfire is lost") {
  const auto extent = [](double sine, double angle_rad) {
    RayDistribution distribution(mills_cross_volume(50, 50, 30 * kDegree), {RaySettings::kPreview}, {1, "rays"});
    distribution.steer(sine, angle_rad);
    std::vector<Ray> rays;
    const std::vector<Hit> nothing(distribution.probes().size());
    distribution.fill(kHead, nothing, {}, kFar_m, rays);
    struct {
      double solid_angle_sr = 0, least_sine = 1, most_sine = -1, least_rad = 4, most_rad = -4;
    } e;
    for (const Ray& ray : rays) {
      REQUIRE(ray.direction_head.norm() == Approx(1).margin(1e-6));
      e.solid_angle_sr += ray.solid_angle_sr;
      e.least_sine = std::min(e.least_sine, double(ray.direction_head.x()));
      e.most_sine = std::max(e.most_sine, double(ray.direction_head.x()));
      e.least_rad = std::min(e.least_rad, across_rad(ray));
      e.most_rad = std::max(e.most_rad, across_rad(ray));
    }
    return e;
  };
  const auto turned = extent(0.1, -20 * kDegree), beyond = extent(0.9, 0);
  CHECK(turned.solid_angle_sr == Approx(0.32 * 60 * kDegree).epsilon(1e-5));
  CHECK(turned.least_sine == Approx(-0.06).margin(0.01));
  CHECK(turned.most_sine == Approx(0.26).margin(0.01));
  CHECK(turned.least_rad == Approx(-50 * kDegree).margin(0.02));
  CHECK(turned.most_rad == Approx(10 * kDegree).margin(0.02));
  CHECK(beyond.solid_angle_sr == Approx(0.26 * 60 * kDegree).epsilon(1e-5));
}

TEST_CASE("the limit of rays holds, and every cell gives way") {
  const Scene scene = scene_of(flat);
  const Sounding all = sound(scene, {RaySettings::kNormal, 0.075}),
                 some = sound(scene, {RaySettings::kNormal, 0.075, 10'000});
  CHECK(all.share == 1.0);
  CHECK(some.share < 0.2);
  CHECK(some.rays.size() <= 10'000);
  CHECK(some.rays.size() > 9'000);
  double sum = 0;
  for (const Ray& ray : some.rays) sum += ray.solid_angle_sr;
  CHECK(sum == Approx(2 * 8.0 / 50 * 2 * 67.5 * kDegree).epsilon(1e-5));
  CHECK(sound(scene, {RaySettings::kNormal, 1e-9, 10'000}).rays.size() <= 10'000);
}

TEST_CASE("there are never fewer rays than asked for, where there is anything to hit") {
  const Scene scene = scene_of(flat);
  const Sounding few = sound(scene, {RaySettings::kPreview, 1.0}),
                 filled = sound(scene,
                                {.quality = RaySettings::kPreview, .range_resolution_m = 1.0, .fewest_rays = 120'000});
  REQUIRE(few.rays.size() < 20'000);
  CHECK(filled.rays.size() >= 30'000);  // a quarter, as the quality is
  CHECK(filled.rays.size() < 33'000);
  CHECK(filled.share > 1.3);
  double sum = 0;
  for (const Ray& ray : filled.rays) sum += ray.solid_angle_sr;
  CHECK(sum == Approx(2 * 8.0 / 50 * 2 * 67.5 * kDegree).epsilon(1e-5));
  CHECK(sound(Scene({0, 0}), {.fewest_rays = 80'000}).rays.size() < 10'000);
}

TEST_CASE("the same pose over the same tiles has the same rays, on any number of threads") {
  const Scene scene = scene_of([](double x, double y) { return -20 + std::sin(x) + std::cos(2 * y); }, 0.5, 200);
  const auto with = [&](std::size_t threads, std::uint64_t seed) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return sound(scene, {RaySettings::kPreview, 0.075}, seed).rays;
  };
  const auto one = with(1, 1), two = with(2, 1), other = with(2, 2);
  REQUIRE(one.size() == two.size());
  CHECK(std::memcmp(one.data(), two.data(), one.size() * sizeof(Ray)) == 0);
  CHECK(one[77].direction_head != other[77].direction_head);
}

TEST_CASE("heads on the seabed, below it and above an edge have rays of finite direction") {
  const Scene scene = scene_of(flat, 0.5, 40);
  for (const double z : {-20.0, -20.0001, -19.999, -25.0, 5.0}) {
    for (const double x : {0.0, 10.0, 10.1, 80.0}) {
      const Sounding s = sound(scene, {RaySettings::kPreview, 0.075, 20'000}, 1, {{x, 0, z}, kHead.enu_from_head});
      CHECK(s.rays.size() <= 20'000);
      for (const Ray& ray : s.rays) REQUIRE(ray.direction_head.norm() == Approx(1).margin(1e-6));
    }
  }
}

TEST_CASE("a volume that is none, and settings that cannot be, are refused") {
  const auto make = [](TransmitVolume volume, RaySettings settings = {}) {
    RayDistribution{volume, settings, Stream{1, "rays"}};
  };
  TransmitVolume volume = mills_cross();
  volume.sine.low = -1.1;
  CHECK_THROWS_WITH(make(volume),
                    "the sines of a transmit volume must rise within -1..1, and its beams be wider than 0");
  volume = mills_cross();
  volume.angle_rad.beam = 0;
  CHECK_THROWS_WITH(make(volume), "the angles of a transmit volume must rise, and its beams be wider than 0");
  volume.angle_rad = {-3, 3.3, -3, 3.3, 1};
  CHECK_THROWS_WITH(make(volume), "the angles of a transmit volume must span at most a full circle");
  CHECK_THROWS_WITH(make(mills_cross(), {.range_resolution_m = 0}), "the range resolution must be above 0 m");
  CHECK_THROWS_WITH(make(mills_cross(), {.quality = 0}), "the quality of rays must be above 0");
  CHECK_THROWS_WITH(make(mills_cross(), {.most_rays = 10'000, .fewest_rays = 5'001}),
                    "the fewest rays times the quality must be at most half of the most");
  CHECK_THROWS_WITH(make(mills_cross(), {.most_rays = 100}), Catch::Contains("the limit of rays must be at least "));
  RayDistribution distribution(mills_cross(), {}, {1, "rays"});
  std::vector<Ray> rays;
  CHECK_THROWS_WITH(distribution.fill(kHead, {}, {}, kFar_m, rays), "there must be one hit per probe");
}

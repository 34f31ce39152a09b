#include "kernels/acoustics/trace/ray_distribution.h"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numbers>

#include "kernels/acoustics/trace/testing/sounding.h"

using namespace ensonify::trace;
using namespace ensonify::trace::sounding;
using namespace ensonify::terrain;
using Catch::WithinAbs;
using ensonify::frames::HeadPose;
using ensonify::random::Stream;

TEST_CASE("the solid angles of a distribution sum to that of its volume, whatever it sees") {
  const Scene seabed = scene_of([](double x, double y) { return -20 + std::sin(x) + std::cos(2 * y); }, 0.5, 200);
  for (const double quality : {RaySettings::kPreview, RaySettings::kNormal}) {
    double sum = 0;
    for (const Ray& ray : trace_ping(seabed, {quality, 0.075}).rays) {
      sum += ray.solid_angle_sr;
      REQUIRE_THAT(ray.direction_head.norm(), WithinAbs(1, 1e-6));
    }
    CHECK(sum == Approx(2 * 8.0 / 50 * 2 * 67.5 * kDegree).epsilon(1e-5));  // du dphi
  }
  CHECK(trace_ping(Scene({0, 0}), {}).rays.size() >= 1024);  // nothing to see: one ray per cell
}

TEST_CASE("rays lie in the volume, about either axis of the head") {
  const TransmitVolume ahead{TransmitVolume::Axis::kDown,
                             {-0.1, 0.3, -0.1, 0.3, 0.4},
                             {-60 * kDegree, 20 * kDegree, -60 * kDegree, 20 * kDegree, 1 * kDegree}};
  const HeadPose tilted{{0, 0, 0}, enu_from_body(ensonify::frames::Attitude{0, -0.3, 0})};
  double sum = 0;
  float lowest = 1, highest = -1, port = 0, starboard = 0;
  for (const Ray& ray : trace_ping(scene_of(flat, 0.5, 400), {RaySettings::kPreview, 0.1}, 1, tilted, ahead).rays) {
    sum += ray.solid_angle_sr;
    const float azimuth = std::atan2(ray.direction_head.y(), ray.direction_head.x());
    lowest = std::min(lowest, ray.direction_head.z()), highest = std::max(highest, ray.direction_head.z());
    port = std::min(port, azimuth), starboard = std::max(starboard, azimuth);
  }
  CHECK(sum == Approx(0.4 * 80 * kDegree).epsilon(1e-5));
  CHECK_THAT(lowest, WithinAbs(-0.1, 0.01));
  CHECK_THAT(highest, WithinAbs(0.3, 0.01));
  CHECK_THAT(port, WithinAbs(-60 * kDegree, 0.01));
  CHECK_THAT(starboard, WithinAbs(20 * kDegree, 0.01));
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
    const Sounding s = trace_ping(scene, {quality, 0.075});
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
      CHECK_THAT(10 * std::log10(level[static_cast<std::size_t>(sector)] / exact), WithinAbs(0, 0.1));
    }
  }
}

TEST_CASE("rays follow range cells, not beams") {
  const Scene scene = scene_of(flat, 2.0, 100);  // few facets, so range cells decide
  const auto rays = [&](double resolution_m, double receive_waves) {
    const auto volume = mills_cross_volume(50, receive_waves, kSwath_rad);
    return static_cast<double>(trace_ping(scene, {RaySettings::kNormal, resolution_m}, 1, kHead, volume).rays.size());
  };
  // Twice the range cells, twice the rays, but near nadir, where a beam is within one range cell.
  CHECK(rays(0.005, 50) / rays(0.01, 50) == Approx(2).epsilon(0.1));
  // Narrower receive beams cut the seabed finer near nadir only.
  CHECK(rays(0.01, 100) / rays(0.01, 50) == Approx(1).epsilon(0.1));
  CHECK(rays(0.01, 100) > rays(0.01, 50));
}

TEST_CASE("a steered volume keeps its solid angles, but for what is beyond endfire") {
  const auto extent = [](double sine, double angle_rad) {
    RayDistribution distribution(mills_cross_volume(50, 50, 30 * kDegree), {RaySettings::kPreview}, {1, "rays"});
    RayDistribution::Plan plan;
    RayDistribution::Batch all;
    const auto nothing = [](const Rays& rays, Hits& hits) { hits.resize(rays.size()); };
    distribution.aim(kHead, {sine, angle_rad}, {}, kFar_m, nullptr, nothing, plan);
    distribution.trace(plan, 0, plan.rays(), nothing, all);
    struct {
      double solid_angle_sr = 0, least_sine = 1, most_sine = -1, least_rad = 4, most_rad = -4;
    } e;
    for (const Ray& ray : all.rays) {
      REQUIRE_THAT(ray.direction_head.norm(), WithinAbs(1, 1e-6));
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
  CHECK_THAT(turned.least_sine, WithinAbs(-0.06, 0.01));
  CHECK_THAT(turned.most_sine, WithinAbs(0.26, 0.01));
  CHECK_THAT(turned.least_rad, WithinAbs(-50 * kDegree, 0.02));
  CHECK_THAT(turned.most_rad, WithinAbs(10 * kDegree, 0.02));
  CHECK(beyond.solid_angle_sr == Approx(0.26 * 60 * kDegree).epsilon(1e-5));
}

TEST_CASE("the limit of rays holds, and every cell gives way") {
  const Scene scene = scene_of(flat);
  const Sounding all = trace_ping(scene, {RaySettings::kNormal, 0.075}),
                 some = trace_ping(scene, {RaySettings::kNormal, 0.075, 10'000});
  CHECK(all.share == 1.0);
  CHECK(some.share < 0.2);
  CHECK(some.rays.size() <= 10'000);
  CHECK(some.rays.size() > 9'000);
  double sum = 0;
  for (const Ray& ray : some.rays) sum += ray.solid_angle_sr;
  CHECK(sum == Approx(2 * 8.0 / 50 * 2 * 67.5 * kDegree).epsilon(1e-5));
  CHECK(trace_ping(scene, {RaySettings::kNormal, 1e-9, 10'000}).rays.size() <= 10'000);
}

TEST_CASE("there are never fewer rays than asked for, where there is anything to hit") {
  const Scene scene = scene_of(flat);
  const Sounding few = trace_ping(scene, {RaySettings::kPreview, 1.0}),
                 filled = trace_ping(
                     scene, {.quality = RaySettings::kPreview, .range_resolution_m = 1.0, .fewest_rays = 120'000});
  REQUIRE(few.rays.size() < 20'000);
  CHECK(filled.rays.size() >= 30'000);  // a quarter, as the quality is
  CHECK(filled.rays.size() < 33'000);
  CHECK(filled.share > 1.3);
  double sum = 0;
  for (const Ray& ray : filled.rays) sum += ray.solid_angle_sr;
  CHECK(sum == Approx(2 * 8.0 / 50 * 2 * 67.5 * kDegree).epsilon(1e-5));
  CHECK(trace_ping(Scene({0, 0}), {.fewest_rays = 80'000}).rays.size() < 10'000);
}

TEST_CASE("the same pose over the same tiles has the same rays, on any number of threads") {
  const Scene scene = scene_of([](double x, double y) { return -20 + std::sin(x) + std::cos(2 * y); }, 0.5, 200);
  const auto with = [&](std::size_t threads, std::uint64_t seed) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return trace_ping(scene, {RaySettings::kPreview, 0.075}, seed).rays;
  };
  const auto one = with(1, 1), two = with(2, 1), other = with(2, 2);
  REQUIRE(one.size() == two.size());
  CHECK(one == two);
  CHECK(one[77].direction_head != other[77].direction_head);
}

TEST_CASE("batches in any order have the rays and hits of the whole, and none is longer than asked for") {
  Scene scene = scene_of([](double x, double y) { return -20 + std::sin(x) + std::cos(2 * y); }, 0.5, 200);
  scene.insert({9, 9}, sample_tile({.origin_enu_m = {-2, 8}, .spacing_m = 0.25, .cells = 8}, {0, 0},
                                   [](double, double) { return -17.0; }));  // facets with rays of their own
  const RayDistribution distribution(mills_cross(), {RaySettings::kPreview, 0.075}, {1, "rays"});
  const auto trace = [&](const Rays& rays, Hits& hits) { scene.adapted().trace(kHead, rays, kFar_m, hits); };
  RayDistribution::Plan plan;
  RayDistribution::Batch all, batch;
  distribution.aim(kHead, {}, scene.objects(), kFar_m, nullptr, trace, plan);
  distribution.trace(plan, 0, plan.rays(), trace, all);
  REQUIRE(all.rays.size() == plan.rays());
  for (const std::size_t size : {16U, 4096U, 10'000'000U}) {
    std::size_t seen = 0;
    for (std::size_t first = (plan.rays() - 1) / size * size + size; first > 0;) {  // from the end
      first -= size;
      distribution.trace(plan, first, size, trace, batch);
      REQUIRE(batch.rays.size() <= size);
      seen += batch.rays.size();
      for (std::size_t i = 0; i < batch.rays.size(); ++i) {
        REQUIRE(batch.rays[i].direction_head == all.rays[first + i].direction_head);
        REQUIRE(batch.rays[i].solid_angle_sr == all.rays[first + i].solid_angle_sr);
        REQUIRE(batch.hits[i].position_enu_m == all.hits[first + i].position_enu_m);
        REQUIRE(batch.hits[i].range_m == all.hits[first + i].range_m);
      }
    }
    CHECK(seen == plan.rays());
  }
  distribution.trace(plan, plan.rays(), 100, trace, batch);
  CHECK(batch.rays.empty());
}

TEST_CASE("heads on the seabed, below it and above an edge have rays of finite direction") {
  const Scene scene = scene_of(flat, 0.5, 40);
  for (const double z : {-20.0, -20.0001, -19.999, -25.0, 5.0}) {
    for (const double x : {0.0, 10.0, 10.1, 80.0}) {
      const Sounding s = trace_ping(scene, {RaySettings::kPreview, 0.075, 20'000}, 1, {{x, 0, z}, kHead.enu_from_head});
      CHECK(s.rays.size() <= 20'000);
      for (const Ray& ray : s.rays) REQUIRE_THAT(ray.direction_head.norm(), WithinAbs(1, 1e-6));
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
  RayDistribution::Plan plan;
  const auto none = [](const Rays&, Hits&) {};
  CHECK_THROWS_WITH(distribution.aim(kHead, {}, {}, kFar_m, nullptr, none, plan), "there must be one hit per probe");
  const auto misses = [](const Rays& rays, Hits& hits) { hits.resize(rays.size()); };
  distribution.aim(kHead, {}, {}, kFar_m, nullptr, misses, plan);
  RayDistribution::Batch batch;
  CHECK_THROWS_WITH(distribution.trace(plan, 0, 100, none, batch), "there must be one hit per ray");
}

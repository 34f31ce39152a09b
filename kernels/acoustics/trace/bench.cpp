// How fast one fan of rays hits a tile of seabed, against Embree alone with the same rays and geometry (the floor).
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "kernels/acoustics/trace/ray_distribution.h"
#include "kernels/acoustics/trace/scene.h"
#include "kernels/acoustics/trace/testing/embree_alone.h"
#include "kernels/water/refraction/thermocline.h"
#include "tests/support/fan.h"

using namespace ensonify;

namespace {

constexpr float kMaxRange = 200.0F;
const frames::HeadPose kHead{{3.0, 4.0, -1.0}, frames::enu_from_ned()};

double seabed(double x, double y) { return -20.0 + 0.3 * std::sin(x) * std::sin(1.1 * y) + 0.02 * x; }

const terrain::Tile& tile() {
  static const terrain::Tile value =
      terrain::sample_tile({.origin_enu_m = {-256, -256}, .spacing_m = 0.5}, {0, 0}, seabed);
  return value;
}

trace::Rays fan(int across) {
  trace::Rays rays;
  trace::Fan({.across = across}).fill({1, "rays"}, 0, rays);
  return rays;
}

trace::Scene scene() {
  trace::Scene value({0, 0});
  value.insert({0, 0}, tile());
  return value;
}

/// Both must find the same ranges, or the times mean nothing.
void check() {
  const auto rays = fan(1024);
  trace::Hits hits;
  scene().adapted().trace(kHead, rays, kMaxRange, hits);
  const trace::EmbreeAlone alone(tile());
  auto packets = trace::EmbreeAlone::packets_of(kHead, rays);
  alone.trace(packets, kMaxRange);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i].hit() || std::abs(hits[i].range_m - packets[i / 16].ray.tfar[i % 16]) > 1e-3F) {
      std::fprintf(stderr, "ray %zu: %g m, Embree alone %g m\n", i, hits[i].range_m, packets[i / 16].ray.tfar[i % 16]);
      std::exit(1);
    }
  }
}

void embree_alone(benchmark::State& state) {
  const trace::EmbreeAlone alone(tile());
  auto packets = trace::EmbreeAlone::packets_of(kHead, fan(static_cast<int>(state.range(0))));
  for (auto _ : state) alone.trace(packets, kMaxRange);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(packets.size()) * 16);
}

void trace_fan(benchmark::State& state) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto rays = fan(static_cast<int>(state.range(0)));
  const auto seabed_scene = scene();
  trace::Hits hits;
  for (auto _ : state) seabed_scene.adapted().trace(kHead, rays, kMaxRange, hits);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}

/// Of the processor: fair on a busy machine.
template <class Work>
double ticks_of(const Work& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start);
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Traced {
  trace::RayDistribution::Plan plan;
  trace::RayDistribution::Batch all;
};

void trace_rays(const trace::Scene& seabed, const trace::RayDistribution& distribution, Traced& traced) {
  const auto trace = [&](const trace::Rays& rays, trace::Hits& hits) {
    seabed.adapted().trace(kHead, rays, kMaxRange, hits);
  };
  distribution.aim(kHead, {}, seabed.objects(), kMaxRange, nullptr, trace, traced.plan);
  distribution.trace(traced.plan, 0, traced.plan.rays(), trace, traced.all);
}

/// Probes, distribution and trace over Embree alone with the same rays made beforehand, in turns: 1 is as fast.
void distributed_over_embree(benchmark::State& state) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto seabed_scene = scene();
  const trace::EmbreeAlone alone(tile());
  trace::RayDistribution distribution(trace::mills_cross_volume(50, 50, 1.2),
                                      {0.01 * static_cast<double>(state.range(0)), 0.075}, {1, "rays"});
  Traced traced;
  const trace::Rays& rays = traced.all.rays;
  std::vector<double> ratios;
  const auto whole = [&] { trace_rays(seabed_scene, distribution, traced); };
  whole();
  auto packets = trace::EmbreeAlone::packets_of(kHead, rays);
  for (auto _ : state) {
    const double floor = ticks_of([&] { alone.trace(packets, kMaxRange); });
    ratios.push_back(floor / ticks_of(whole));
  }
  state.counters["rays"] = static_cast<double>(rays.size());
  state.counters["of_embree"] = median(ratios);
}

/// A rock of 1 m in posts of 4 cm, in the main lobe.
terrain::Tile rock() {
  const auto dome = [](double x, double y) {
    const double d2 = (x - 13.0) * (x - 13.0) + (y - 4.0) * (y - 4.0);
    return d2 < 0.25 ? -20.0 + std::sqrt(0.25 - d2) : std::nan("");
  };
  return terrain::sample_tile({.origin_enu_m = {12.48, 3.48}, .spacing_m = 0.04, .cells = 26}, {0, 0}, dome);
}

/// A ping that sees a rock over one that sees none, in turns.
void rock_over_none(benchmark::State& state) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto without = scene();
  auto with = scene();
  with.insert({9, 9}, rock());
  trace::RayDistribution distribution(trace::mills_cross_volume(50, 50, 1.2), {1.0, 0.075}, {1, "rays"});
  Traced traced;
  const auto ping = [&](const trace::Scene& of) {
    trace_rays(of, distribution, traced);
    return static_cast<double>(traced.plan.rays());
  };
  std::vector<double> ratios;
  for (auto _ : state) {
    const double floor = ticks_of([&] { ping(without); });
    ratios.push_back(ticks_of([&] { ping(with); }) / floor);
  }
  state.counters["rays_none"] = ping(without);
  state.counters["rays"] = ping(with);
  state.counters["rock/none"] = median(ratios);
}

/// A head under the surface of a stratified sea: 80 m of water, relief below 5 m.
const frames::HeadPose kHigh{{3.0, 4.0, -1.0}, frames::enu_from_ned()};
constexpr float kFar = 400.0F;

double deep_seabed(double x, double y) { return -78.0 + 2.0 * std::sin(0.05 * x) * std::sin(0.06 * y); }

trace::Scene deep_scene() {
  trace::Scene value({0, 0});
  value.insert({0, 0}, terrain::sample_tile({.origin_enu_m = {-512, -512}, .spacing_m = 1.0}, {0, 0}, deep_seabed));
  return value;
}

/// Refracted rays must end where exact arcs do, or their time means nothing.
void check_refracted(const trace::Rays& rays, const trace::Hits& hits, const refraction::PathTable& paths) {
  for (std::size_t i = 0; i < rays.size(); i += 37) {
    const frames::Vec3 d = rays[i].direction_head.cast<double>(), off = hits[i].position_enu_m - kHigh.position_enu_m;
    const auto exact =
        refraction::path_at_horizontal(paths.profile(), paths.source_depth_m(),
                                       std::atan2(d.z(), std::hypot(d.x(), d.y())), std::hypot(off.x(), off.y()));
    const double miss = (exact.depth_m + hits[i].position_enu_m.z()) * std::cos(exact.depression_rad);
    if (!hits[i].hit() || std::abs(miss) > 1e-3 || std::abs(hits[i].travel_time_s / exact.travel_time_s - 1) > 1e-5) {
      std::fprintf(stderr, "bent ray %zu misses its path by %g m\n", i, miss);
      std::exit(1);
    }
  }
}

/// Bent over straight rays to the same seabed, in turns; the table is built for every ping.
void refracted_over_straight(benchmark::State& state) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto rays = fan(static_cast<int>(state.range(0)));
  const auto seabed_scene = deep_scene();
  const auto water = refraction::summer_thermocline();
  refraction::PathTable paths;
  trace::Hits refracted, straight;
  std::vector<double> ratios;
  for (auto _ : state) {
    const double floor = ticks_of([&] { seabed_scene.adapted().trace(kHigh, rays, kFar, straight); });
    ratios.push_back(ticks_of([&] {
                       seabed_scene.adapted().tabulate(water, kHigh, 1.0, kFar, paths);
                       seabed_scene.adapted().trace(kHigh, rays, kFar, refracted, paths);
                     }) /
                     floor);
  }
  check_refracted(rays, refracted, paths);
  state.counters["bent/straight"] = median(ratios);
  state.SetItemsProcessed(state.iterations() * 2 * static_cast<std::int64_t>(rays.size()));
}

void fill_fan(benchmark::State& state) {
  const trace::Fan shape({.across = 1024});
  trace::Rays rays;
  std::uint64_t ping = 0;
  for (auto _ : state) shape.fill({1, "rays"}, ping++, rays);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}

void insert_tile(benchmark::State& state) {
  trace::Scene value({0, 0});
  for (auto _ : state) value.insert({0, 0}, tile());
}

BENCHMARK(embree_alone)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);
BENCHMARK(trace_fan)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);
BENCHMARK(distributed_over_embree)->ArgName("quality_pct")->Arg(25)->Arg(100)->Arg(400)->Unit(benchmark::kMillisecond);
BENCHMARK(rock_over_none)->Unit(benchmark::kMillisecond);
BENCHMARK(refracted_over_straight)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);
BENCHMARK(fill_fan)->Unit(benchmark::kMillisecond);
BENCHMARK(insert_tile)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  check();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}

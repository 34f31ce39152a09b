// What a table of paths costs to build, and a path to look up, against computing it leg by leg.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "kernels/water/refraction/path_table.h"
#include "kernels/water/refraction/thermocline.h"

using namespace ensonify::refraction;

namespace {

constexpr double kLevel = 77.0;

/// The thermocline cut into more layers.
SoundSpeedProfile water(int layers) {
  std::vector<Knot> knots;
  for (int i = 0; i <= layers; ++i) {
    const double depth = 80.0 * i / layers;
    knots.push_back({depth, summer_thermocline().speed_mps(depth)});
  }
  return SoundSpeedProfile(knots);
}

double depression_rad(int i) { return 0.25 + 1.3 * (i % 1024) / 1024.0; }

void check() {
  PathTable table;
  table.build(water(10), 0, kLevel);
  for (int i = 0; i < 1024; ++i) {
    const double exact = path_to_depth(table.profile(), 0, depression_rad(i), kLevel)->travel_time_s;
    if (std::abs(table.at(depression_rad(i), kLevel)->travel_time_s / exact - 1) < 1e-6) continue;
    std::fprintf(stderr, "the table's time is wrong at %g rad\n", depression_rad(i));
    std::exit(1);
  }
}

void build_table(benchmark::State& state) {
  const auto profile = water(static_cast<int>(state.range(0)));
  PathTable table;
  for (auto _ : state) table.build(profile, 0, kLevel);
}

void look_up(benchmark::State& state) {
  PathTable table;
  table.build(water(static_cast<int>(state.range(0))), 0, kLevel);
  int i = 0;
  for (auto _ : state) {
    const double angle = depression_rad(i++);
    benchmark::DoNotOptimize(table.path(std::sin(angle), std::cos(angle)).at());
  }
}

void leg_by_leg(benchmark::State& state) {
  const auto profile = water(static_cast<int>(state.range(0)));
  int i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(path_to_depth(profile, 0, depression_rad(i++), kLevel));
}

void find_eigenray(benchmark::State& state) {
  const auto profile = water(static_cast<int>(state.range(0)));
  int i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(eigenray(profile, 1, 1.0 + 0.25 * (i++ % 1024), kLevel));
}

BENCHMARK(build_table)->Arg(10)->Arg(50)->Unit(benchmark::kMicrosecond);
BENCHMARK(look_up)->Arg(10)->Arg(50);
BENCHMARK(leg_by_leg)->Arg(10)->Arg(50);
BENCHMARK(find_eigenray)->Arg(10)->Arg(50);

}  // namespace

int main(int argc, char** argv) {
  check();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}

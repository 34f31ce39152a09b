// How fast relief is made: posts per second of one thread, tile by tile. Every case checks its rms before it is timed.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "kernels/seabed/relief/bodies.h"
#include "kernels/seabed/relief/guide.h"
#include "kernels/seabed/relief/marks.h"
#include "kernels/seabed/relief/mask.h"
#include "kernels/seabed/relief/ripples.h"
#include "kernels/seabed/relief/seabed.h"
#include "kernels/seabed/relief/spectral_surface.h"

using namespace ensonify::relief;

namespace {

constexpr double kSpacing = 0.1;
constexpr int kPosts = 1025;

template <class Kernel>
Field owned(Kernel kernel) {
  return [kernel = std::move(kernel)](const Window& window, std::span<float> out) { kernel.fill(window, out); };
}

Field relief(double rms_m, double outer_scale_m, const char* name, const Field& amplitude = nullptr) {
  const SpectralSurface surface({.rms_m = rms_m, .outer_scale_m = outer_scale_m}, kSpacing, 1, name);
  return [surface, amplitude](const Window& window, std::span<float> out) { surface.fill(window, out, amplitude); };
}

Field rock() {
  const LognormalCascade cascade({.intermittency = 0.25, .outer_scale_m = 50.0}, kSpacing, 1, "rock");
  return relief(0.5, 50.0, "rock", owned(cascade));
}

Field ripples() { return owned(Ripples({.wavelength_m = 2.0, .height_m = 0.15}, kSpacing, 1, "ripples")); }

Field boulders() {
  return owned(Bodies({.per_km2 = 2000.0, .smallest_radius_m = 0.3, .largest_radius_m = 3.0}, kSpacing, 1, "boulders"));
}

Field scars() { return owned(Marks({.tracks_per_km2 = 20.0}, kSpacing, 1, "scars")); }

/// A guide of 8 m cells, made of noise of long waves.
Field guide() {
  Raster raster{160, 160, 8.0, {-40.0, -40.0}, std::vector<float>(160 * 160)};
  const SpectralSurface shape({.rms_m = 3.0, .outer_scale_m = 400.0, .inner_scale_m = 60.0}, 8.0, 1, "shape");
  shape.fill({0, 0, 0, 160, 160}, raster.value);
  return sum({constant(-25.0F), smooth_surface(raster, kSpacing)});
}

/// All of it: guide, rock with sand over it, rippled where the guide is flat, boulders and scars.
Field whole_seabed() {
  const Field base = guide();
  const Field flat = in_band(slope_of(base, kSpacing, 6), {.high = 0.1, .softness = 0.05});
  const Field sand = sum({base, constant(-0.1F), relief(0.02, 20.0, "sand")});
  const Seabed seabed(base, nullptr,
                      {{.height_m = rock(), .sediment = 1},
                       {.height_m = sand, .join = Layer::Join::kCover, .sediment = 2},
                       {.height_m = ripples(), .mask = flat},
                       {.height_m = boulders(), .sediment = 3},
                       {.height_m = scars()}});
  return [seabed](const Window& window, std::span<float> out) {
    std::vector<std::uint8_t> sediment(out.size());
    seabed.fill(window, out, sediment);
  };
}

void run(benchmark::State& state, const Field& field, double low_rms_m, double high_rms_m) {
  Window window{0, 0, 1024 * state.thread_index(), kPosts, kPosts};
  std::vector<float> out(window.size());
  double squares = 0.0;
  for (; window.east < 8 * 1024; window.east += 1024) {
    field(window, out);
    for (const float z : out) squares += static_cast<double>(z) * z;
  }
  const double rms_m = std::sqrt(squares / (8.0 * static_cast<double>(out.size())));
  if (!(rms_m > low_rms_m && rms_m < high_rms_m)) {
    std::fprintf(stderr, "rms %g m, expected %g to %g\n", rms_m, low_rms_m, high_rms_m);
    std::exit(1);
  }
  for (auto _ : state) {
    field(window, out);
    window.east = (window.east + 1024) % (8 * 1024);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(out.size()));
}

BENCHMARK_CAPTURE(run, guide, guide(), 20.0, 30.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, spectral, relief(0.5, 50.0, "plain"), 0.4, 0.6)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, multifractal, rock(), 0.3, 0.7)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, ripples, ripples(), 0.04, 0.07)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, boulders, boulders(), 0.005, 0.2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, scars, scars(), 0.002, 0.1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, whole_seabed, whole_seabed(), 20.0, 30.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run, whole_seabed_two_threads, whole_seabed(), 20.0, 30.0)
    ->Unit(benchmark::kMillisecond)
    ->Threads(2)
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();

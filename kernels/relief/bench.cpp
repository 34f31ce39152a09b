// How fast relief is made: posts per second of one thread, tile by tile. Every case checks its rms before it is timed.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "kernels/relief/spectral_surface.h"

using namespace ensonify::relief;

namespace {

constexpr double kSpacing = 0.1;
constexpr int kPosts = 1025;

void run(benchmark::State& state, const Field& field, double low_rms_m, double high_rms_m) {
  Window window{0, 0, 0, kPosts, kPosts};
  std::vector<float> out(window.size());
  double squares = 0.0;
  for (window.east = 0; window.east < 8 * 1024; window.east += 1024) {
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
    window.east += 1024;
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(out.size()));
}

void spectral(benchmark::State& state) {
  const SpectralSurface surface({.rms_m = 0.5, .hurst = 0.625, .outer_scale_m = 50.0}, kSpacing, 1, "bench");
  run(
      state, [&](const Window& w, std::span<float> out) { surface.fill(w, out); }, 0.4, 0.6);
}

BENCHMARK(spectral)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();

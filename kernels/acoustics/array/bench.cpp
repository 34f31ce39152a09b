// How fast a ray's transmit pattern is looked up. The floor is adding up the rays' sines, the alternative is the sum
// over elements.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "kernels/acoustics/array/line.h"

using namespace ensonify::array;

namespace {

const LineArray kLine{.spacing_m = 0.5, .weights = shading_weights({.window = Shading::Window::kTaylor}, 200)};

/// 4096 sines from -1 to 1, out of order.
std::vector<double> sines() {
  std::vector<double> all;
  for (unsigned i = 0; i < 4096; ++i) all.push_back((i * 2654435761U % 4096U) / 2048.0 - 1.0);
  return all;
}

void check() {
  const PatternTable table(kLine, 1.0);
  for (const double u : sines()) {
    if (std::abs(std::complex<double>(table.amplitude(u)) - amplitude(kLine, 1.0, u)) > 1e-4) {
      std::fprintf(stderr, "bench_array: the table is wrong at %g\n", u);
      std::exit(1);
    }
  }
}

template <typename Function>
void over_sines(benchmark::State& state, const Function& value) {
  const auto all = sines();
  for (auto _ : state) {
    double sum = 0.0;
    for (const double u : all) sum += value(u);
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}

void sine_floor(benchmark::State& state) {
  over_sines(state, [](double u) { return u; });
}
BENCHMARK(sine_floor);

void look_up(benchmark::State& state) {
  const PatternTable table(kLine, 1.0);
  over_sines(state, [&](double u) { return table.power(u); });
}
BENCHMARK(look_up);

void direct_sum(benchmark::State& state) {
  over_sines(state, [](double u) { return power(kLine, 1.0, u); });
}
BENCHMARK(direct_sum);

}  // namespace

int main(int argc, char** argv) {
  check();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}

// How fast backscatter is looked up: the direct model, the tables, and a floor that only reads and writes the same
// memory.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "kernels/seabed/table.h"

using namespace ensonify::seabed;

namespace {

/// Of one ping: what the tracer hands over, in an order without pattern.
struct Hits {
  std::vector<float> sin_grazing;
  std::vector<std::uint8_t> seabed_class;
  std::vector<float> sigma;

  explicit Hits(std::size_t count) : sin_grazing(count), seabed_class(count), sigma(count) {
    std::uint32_t state = 1;
    for (std::size_t i = 0; i < count; ++i) {
      state = 1664525U * state + 1013904223U;
      sin_grazing[i] = std::sin(static_cast<float>(state >> 8) * 0x1p-24F * 1.5708F);
      seabed_class[i] = static_cast<std::uint8_t>((state >> 4) % 14U);
    }
  }
};

std::vector<Law> laws() {
  std::vector<Law> value;
  for (const auto& row : named_sediments()) value.push_back(law_of(row.parameters, 300e3, 1500.0));
  return value;
}

/// The tables must give what the model gives, or the times mean nothing.
void check() {
  const auto direct = laws();
  const ClassTables tables(direct);
  const Hits hits(10000);
  for (std::size_t i = 0; i < hits.sigma.size(); ++i) {
    const double exact = direct[hits.seabed_class[i]](std::asin(hits.sin_grazing[i]));
    const double error_db = 10.0 * std::log10(tables(hits.seabed_class[i], hits.sin_grazing[i]) / exact);
    if (std::abs(error_db) > 0.1) {
      std::fprintf(stderr, "sine %g, class %d: %g dB off\n", hits.sin_grazing[i], hits.seabed_class[i], error_db);
      std::exit(1);
    }
  }
}

void direct_model(benchmark::State& state) {
  const auto direct = laws();
  Hits hits(10000);
  for (auto _ : state) {
    for (std::size_t i = 0; i < hits.sigma.size(); ++i) {
      hits.sigma[i] = static_cast<float>(direct[hits.seabed_class[i]](std::asin(hits.sin_grazing[i])));
    }
    benchmark::DoNotOptimize(hits.sigma.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(hits.sigma.size()));
}

template <typename LookUp>
void stream(benchmark::State& state, const LookUp& look_up) {
  Hits hits(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    for (std::size_t i = 0; i < hits.sigma.size(); ++i) {
      hits.sigma[i] = look_up(hits.seabed_class[i], hits.sin_grazing[i]);
    }
    benchmark::DoNotOptimize(hits.sigma.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(hits.sigma.size()));
}

void one_table(benchmark::State& state) {
  const BackscatterTable table(laws()[6]);
  stream(state, [&](std::uint8_t, float sine) { return table(sine); });
}

void class_tables(benchmark::State& state) {
  const auto direct = laws();
  const ClassTables tables(direct);
  stream(state, [&](std::uint8_t id, float sine) { return tables(id, sine); });
}

/// Reads the same inputs, writes the same output, does next to nothing between.
void memory_floor(benchmark::State& state) {
  stream(state, [](std::uint8_t id, float sine) { return sine + static_cast<float>(id); });
}

void build_table(benchmark::State& state) {
  const auto law = laws()[6];
  for (auto _ : state) benchmark::DoNotOptimize(BackscatterTable(law));
}

BENCHMARK(direct_model)->Unit(benchmark::kMillisecond);
BENCHMARK(one_table)->Arg(1 << 20)->Unit(benchmark::kMillisecond);
BENCHMARK(class_tables)->Arg(1 << 20)->Unit(benchmark::kMillisecond);
BENCHMARK(memory_floor)->Arg(1 << 20)->Unit(benchmark::kMillisecond);
BENCHMARK(build_table)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  check();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}

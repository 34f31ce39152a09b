// Detections a second by amplitude and phase, on one core. The floor is one pass over the same memory.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "kernels/acoustics/array/beam_layout.h"
#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/detect/testing/plane_echo.h"

using namespace ensonify;

namespace {

/// 256 beams of 1 degree over 130 degrees, a level plane in 20 m, 20 dB.
struct Ping {
  detect::PlaneSurvey survey;
  detect::PlaneEcho echo;
  std::vector<detect::Detection> found;

  Ping() {
    for (const float angle : array::equiangular_beams_rad(65.0F * 3.14159265F / 180.0F, 256)) {
      survey.sin_beams.push_back(std::sin(angle));
    }
    echo.ping(survey, {1, "plane"}, 0);
  }
  void detect(bool with_phase) {
    detect::detect_bottom(detect::settings_for(survey), survey.sin_beams, echo.amplitudes(survey),
                          with_phase ? echo.halves() : detect::HalfApertures{}, found);
  }
};

/// The depths must be right, or the times mean nothing.
void check() {
  Ping ping;
  ping.detect(true);
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < ping.found.size(); ++i) {
    if (!ping.found[i].valid) continue;
    sum += ping.found[i].two_way_s / detect::two_way_s(ping.survey, ping.survey.sin_beams[i]);
    count += 1.0;
  }
  if (!(count > 240.0 && std::abs(sum / count - 1.0) < 2e-4)) {
    std::fprintf(stderr, "%g detections, mean depth off by %g\n", count, sum / count - 1.0);
    std::exit(1);
  }
}

void one_pass(benchmark::State& state) {
  const Ping ping;
  for (auto _ : state) {
    float sum = 0.0F;
    for (const float a : ping.echo.amplitude_upa) sum += a * a;
    if (state.range(0) != 0) {
      for (std::size_t i = 0; i < ping.echo.positive_upa.size(); ++i) {
        sum += std::real(ping.echo.positive_upa[i]) * std::real(ping.echo.negative_upa[i]);
      }
    }
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * 256);
}

void detection(benchmark::State& state) {
  Ping ping;
  for (auto _ : state) ping.detect(state.range(0) != 0);
  state.SetItemsProcessed(state.iterations() * 256);
}

BENCHMARK(one_pass)->ArgName("phase")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(detection)->ArgName("phase")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  check();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}

// How fast the hits of one ping become beams and samples, noise is added and the bottom detected, on one core. The
// floor of the sum is as many complex additions at as many places, with no patterns.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "kernels/array/line.h"
#include "kernels/detect/bottom.h"
#include "kernels/echo/echo.h"
#include "kernels/echo/noise.h"
#include "kernels/seabed/lambert.h"

using namespace ensonify;

namespace {

constexpr double kDepth = 25.0, kDeg = 3.14159265358979 / 180.0;
const echo::Sampling kSampling{0.0, 47.5e-6, 2000};

/// 256 beams of 1 degree over 130 degrees and a flat Lambert seabed.
struct Ping {
  echo::Sonar sonar;
  std::vector<float> beams;
  std::vector<trace::Ray> rays;
  std::vector<trace::Hit> hits;
  std::vector<float> backscatter;
  std::vector<frames::HeadPose> poses{100};
  echo::Workspace workspace;
  echo::Image image;
  std::vector<float> amplitude;

  explicit Ping(int across) {
    for (const float angle : array::equiangular_beams_rad(65 * kDeg, 256)) beams.push_back(std::sin(angle));
    trace::Fan({.across = across}).fill({1, "rays"}, 0, rays);
    for (const auto& ray : rays) {
      const frames::Vec3 enu = poses[0].enu_from_head * ray.direction_head.cast<double>();
      const double range = kDepth / -enu.z();
      hits.push_back({range * enu, {0, 0, 1}, static_cast<float>(range), static_cast<float>(-enu.z()), 0});
      backscatter.push_back(static_cast<float>(seabed::lambert_backscatter(-25, -enu.z())));
    }
  }
  void accumulate(std::uint64_t number) {
    echo::accumulate(sonar, beams, kSampling, {number, rays, hits, backscatter}, {0, 1e-3, poses}, {1, "phase"},
                     workspace, image);
  }
  void finish(std::uint64_t number) {
    echo::add_noise(45, number, {1, "noise"}, image);
    echo::amplitude_upa(image, amplitude);
  }
  std::vector<detect::Detection> detect() const {
    std::vector<detect::Detection> found;
    detect::detect_bottom({.absorption_dbpm = sonar.absorption_dbpm}, beams,
                          {image.beams, image.samples, 0.0, kSampling.period_s, amplitude}, found);
    return found;
  }
};

/// The mean depth of a ping must be right, or the times mean nothing.
void check() {
  Ping ping(1024);
  ping.accumulate(0);
  ping.finish(0);
  const auto found = ping.detect();
  double sum = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    sum += found[i].valid ? 750.0 * found[i].two_way_s * std::sqrt(1.0 - ping.beams[i] * ping.beams[i]) : NAN;
  }
  if (!(std::abs(sum / 256 - kDepth) < 0.02)) {
    std::fprintf(stderr, "mean depth %g m, not %g\n", sum / 256, kDepth);
    std::exit(1);
  }
}

void additions_alone(benchmark::State& state) {
  Ping ping(static_cast<int>(state.range(0)));
  ping.accumulate(0);
  const float reach = static_cast<float>(ping.sonar.receive_reach / ping.sonar.receive_length_in_waves);
  const auto& arrivals = ping.workspace.arrivals;
  std::vector<std::pair<std::size_t, std::size_t>> heard;  // by each beam
  for (const float beam : ping.beams) {
    std::size_t first = 0, end = arrivals.size();
    while (arrivals[first].sine < beam - reach) ++first;
    while (end > first && arrivals[end - 1].sine > beam + reach) --end;
    heard.emplace_back(first, end);
  }
  for (auto _ : state) {
    for (int beam = 0; beam < ping.image.beams; ++beam) {
      float* row = reinterpret_cast<float*>(ping.image.row(beam).data());
      const auto [first, end] = heard[static_cast<std::size_t>(beam)];
      for (std::size_t i = first; i < end; ++i) {
        for (int k = arrivals[i].first; k < arrivals[i].end; ++k) {
          row[2 * k] += arrivals[i].re_upa;
          row[2 * k + 1] += arrivals[i].im_upa;
        }
      }
    }
    benchmark::ClobberMemory();
  }
}

void accumulate(benchmark::State& state) {
  Ping ping(static_cast<int>(state.range(0)));
  std::uint64_t number = 0;
  for (auto _ : state) ping.accumulate(number++);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ping.rays.size()));
}

void noise(benchmark::State& state) {
  Ping ping(256);
  ping.accumulate(0);
  std::uint64_t number = 0;
  for (auto _ : state) echo::add_noise(45, number++, {1, "noise"}, ping.image);
  state.SetItemsProcessed(state.iterations() * 256 * kSampling.count);
}

void amplitude(benchmark::State& state) {
  Ping ping(256);
  ping.accumulate(0);
  for (auto _ : state) echo::amplitude_upa(ping.image, ping.amplitude);
}

void detection(benchmark::State& state) {
  Ping ping(1024);
  ping.accumulate(0);
  ping.finish(0);
  for (auto _ : state) benchmark::DoNotOptimize(ping.detect());
}

BENCHMARK(additions_alone)->Arg(1024)->Arg(1664)->Unit(benchmark::kMillisecond);
BENCHMARK(accumulate)->Arg(1024)->Arg(1664)->Unit(benchmark::kMillisecond);
BENCHMARK(noise)->Unit(benchmark::kMillisecond);
BENCHMARK(amplitude)->Unit(benchmark::kMillisecond);
BENCHMARK(detection)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  check();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}

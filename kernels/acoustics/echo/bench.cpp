// A complete ping of a multibeam (rays traced, echoes made, beams formed, noise) against Embree alone with the same
// rays and geometry: 153,600 rays, 256 beams, 2,000 samples. Its parts, and one core against two.
#include <benchmark/benchmark.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "kernels/acoustics/array/beam_layout.h"
#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/echo/line_receiver.h"
#include "kernels/acoustics/echo/multipath.h"
#include "kernels/acoustics/echo/speckle_cells.h"
#include "kernels/acoustics/trace/testing/embree_alone.h"
#include "kernels/seabed/backscatter.h"
#include "tests/support/fan.h"

using namespace ensonify;

namespace {

constexpr double kDeg = 3.14159265358979 / 180.0, kWave_m = 5e-3, kTransmitWaves = 50.76;
constexpr float kMaxRange_m = 75.0F;
constexpr echo::Sampling kSampling{0.0, 50e-6, 2000};
const frames::HeadPose kHead{{3.0, 4.0, -1.0}, frames::enu_from_ned()};

double seabed_m(double x, double y) { return -25.0 + 0.1 * std::sin(x) * std::sin(1.1 * y) + 0.02 * x; }

const terrain::Tile& tile() {
  static const terrain::Tile value =
      terrain::sample_tile({.origin_enu_m = {-128, -128}, .spacing_m = 0.25}, {0, 0}, seabed_m);
  return value;
}

array::LineArray receive_array() { return array::line_array_of_width(1.0 * kDeg, kWave_m); }

struct Ping {
  trace::Scene scene{{0, 0}};
  trace::Rays rays;
  std::vector<float> source, backscatter, sin_beams;
  trace::Hits hits;
  echo::SpeckleCells cells{0.075, {1, "seabed"}};
  echo::SpeckleCells::Accumulator sum;
  const echo::Scatterers* found = nullptr;
  echo::Receivers receivers;
  echo::Arrivals arrivals;
  echo::LineReceiver receiver{echo::element_line(receive_array(), kWave_m)};
  echo::LineReceiver::Memory memory;
  std::vector<echo::WantedImage> wanted;
  std::vector<echo::Image> images;
  echo::SampledPulse pulse{echo::rectangular_pulse(100e-6), kSampling.period_s};
  random::Stream ambient{1, "noise"};

  explicit Ping(int apertures = 1) : images(static_cast<std::size_t>(apertures)) {
    scene.insert({0, 0}, tile());
    trace::Fan({.transmit_length_in_waves = kTransmitWaves, .half_swath_rad = 67 * kDeg, .along = 24, .across = 6400})
        .fill({1, "rays"}, 0, rays);
    for (const auto& ray : rays) {
      source.push_back(static_cast<float>(1e21 * array::line_power(kTransmitWaves, ray.direction_head.x())));
    }
    for (const float angle : array::equiangular_beams_rad(65 * kDeg, 256)) sin_beams.push_back(std::sin(angle));
    const array::LineArray array = receive_array();
    const auto split = array::split_aperture(array);
    if (apertures == 1) {
      wanted.emplace_back(echo::beam_weights(array.weights));
    } else {
      for (const auto& half : {split.negative, split.positive})
        wanted.emplace_back(echo::beam_weights(half, array.weights));
    }
    receivers.set({0, 1, std::span(&kHead, 1)});
  }
  void trace() { scene.adapted().trace(kHead, rays, kMaxRange_m, hits); }
  void scatter() {
    backscatter.resize(hits.size());
    const auto normal = static_cast<float>(seabed::lambert_backscatter(-25, 1.0));
    for (std::size_t i = 0; i < hits.size(); ++i) backscatter[i] = normal * hits[i].sin_grazing * hits[i].sin_grazing;
    sum.clear();
    cells.add({kHead, rays, hits, source, backscatter}, sum);
    found = &echo::SpeckleCells::gather(sum);
  }
  void arrive() {
    arrivals.clear();
    echo::add_direct_echoes({300e3, 0.07}, kHead.position_enu_m, *found, receivers, arrivals);
  }
  void form(std::uint64_t number) {
    receiver.form(
        {std::array{echo::EchoSet{arrivals}}, pulse, kSampling, {number, 1e5, &ambient, 0.0, nullptr, {}, nullptr}},
        sin_beams, wanted, images, memory);
  }
  void whole(std::uint64_t number) {
    trace();
    scatter();
    arrive();
    form(number);
  }
};

/// Mean level and place of the nadir beam's echo must be right, or the times mean nothing.
void check() {
  Ping ping;
  ping.whole(0);
  const auto row = ping.images[0].row(128);
  double peak = 0.0;
  int place = 0;
  for (int k = 0; k < kSampling.count; ++k) {
    if (std::norm(row[static_cast<std::size_t>(k)]) > peak) {
      peak = std::norm(row[static_cast<std::size_t>(k)]);
      place = k;
    }
  }
  const double range_m = 750 * kSampling.period_s * place, depth_m = -1.0 - seabed_m(3.0, 4.0);
  // Closed form of a flat seabed (docs/physics/acoustics/echo.md), 210 dB and 1 deg both ways, within the spread of one
  // speckle.
  const double area_m2 = std::pow(depth_m * 0.0197, 2);
  const double want_db = 210 - 40 * std::log10(depth_m) - 0.14 * depth_m - 25 + 10 * std::log10(area_m2);
  if (ping.hits.size() != 153600 || std::abs(range_m - depth_m) > 0.3 ||
      std::abs(10 * std::log10(peak) - want_db) > 8) {
    std::fprintf(stderr, "nadir echo at %g m, not %g, level %g dB, not %g\n", range_m, depth_m, 10 * std::log10(peak),
                 want_db);
    std::exit(1);
  }
}

using Limit = tbb::global_control;
constexpr auto kThreads = tbb::global_control::max_allowed_parallelism;

void set_rays(benchmark::State& state, std::size_t rays) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays));
}

/// On two cores: each half of the rays, side by side.
void embree_alone(benchmark::State& state) {
  const Limit limit(kThreads, static_cast<std::size_t>(state.range(0)));
  const trace::EmbreeAlone embree(tile());
  auto packets = trace::EmbreeAlone::packets_of(kHead, Ping().rays);
  for (auto _ : state) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, packets.size(), 64), [&](const auto& range) {
      embree.trace(std::span(packets).subspan(range.begin(), range.size()), kMaxRange_m);
    });
  }
  set_rays(state, packets.size() * 16);
}

void whole_ping(benchmark::State& state) {
  const Limit limit(kThreads, static_cast<std::size_t>(state.range(0)));
  Ping ping(static_cast<int>(state.range(1)));
  std::uint64_t number = 0;
  for (auto _ : state) ping.whole(number++);
  set_rays(state, ping.rays.size());
}

template <class Work>
double wall_s(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// A ping on two cores over Embree alone with its rays on two cores, and over the same ping on one core, in turns.
/// of_embree: 1 is as fast. parallel: 1 is twice as fast on two cores.
void whole_ping_in_turns(benchmark::State& state) {
  const trace::EmbreeAlone embree(tile());
  Ping ping(static_cast<int>(state.range(0)));
  auto packets = trace::EmbreeAlone::packets_of(kHead, ping.rays);
  std::uint64_t number = 0;
  std::vector<double> of_embree, parallel;
  for (auto _ : state) {
    const Limit limit(kThreads, 2);
    const double floor_s = wall_s([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, packets.size(), 64), [&](const auto& range) {
        embree.trace(std::span(packets).subspan(range.begin(), range.size()), kMaxRange_m);
      });
    });
    const double two_s = wall_s([&] { ping.whole(number++); });
    const Limit one(kThreads, 1);
    const double one_s = wall_s([&] { ping.whole(number++); });
    of_embree.push_back(floor_s / two_s);
    parallel.push_back(0.5 * one_s / two_s);
  }
  state.counters["of_embree"] = median(of_embree);
  state.counters["parallel"] = median(parallel);
}

template <class Part>
void part_of_ping(benchmark::State& state, const Part& part) {
  const Limit limit(kThreads, 1);
  Ping ping;
  ping.whole(0);
  for (auto _ : state) part(ping);
  set_rays(state, ping.rays.size());
  state.counters["scatterers"] = static_cast<double>(ping.found->size());
}
void trace_part(benchmark::State& state) {
  part_of_ping(state, [](Ping& ping) { ping.trace(); });
}
void scatterers_part(benchmark::State& state) {
  part_of_ping(state, [](Ping& ping) { ping.scatter(); });
}
void arrivals_part(benchmark::State& state) {
  part_of_ping(state, [](Ping& ping) { ping.arrive(); });
}
void beams_part(benchmark::State& state) {
  part_of_ping(state, [](Ping& ping) { ping.form(1); });
}

/// Echoes of a ping's scatterers for a receiver that moves, of a head with one transmit lobe: straight (0), and by a
/// calm surface too (1).
void echoes_part(benchmark::State& state) {
  const Limit limit(kThreads, 1);
  Ping ping;
  ping.whole(0);
  std::vector<frames::HeadPose> poses;
  for (int i = 0; i < 20; ++i) {
    poses.push_back({kHead.position_enu_m + 0.01 * i * frames::Vec3::UnitX(),
                     frames::enu_from_body({.heading_rad = 1e-3 * i, .roll_rad = 2e-3 * i})});
  }
  ping.receivers.set({0.0, 5e-3, poses});
  array::Pattern transmit;
  transmit.times(array::GaussianFactor{5.0});
  const echo::Multipath multipath{{220.0, {&transmit, 1}}, {}, {}};
  const echo::Multipath* const by = state.range(0) != 0 ? &multipath : nullptr;
  echo::EchoMemory memory;
  for (auto _ : state) echo::make_echoes({300e3, 0.07}, kHead, *ping.found, ping.receivers, by, memory, ping.arrivals);
  set_rays(state, ping.found->size());
}

/// Echoes of a chirp that lasts for 15 samples onto the beams of an imaging head: each arrival is spread over 15
/// samples.
void long_pulse_beams(benchmark::State& state) {
  const Limit limit(kThreads, 1);
  Ping ping;
  ping.whole(0);
  const echo::SampledPulse chirp(echo::compressed_chirp(40e-3, 5e3, echo::Window::kHamming), kSampling.period_s);
  const echo::LineReceiver receiver({102, 0.5});
  std::vector<float> weights(102, 1.0F / 102.0F);
  const std::vector<echo::WantedImage> wanted{echo::WantedImage(weights)};
  for (auto _ : state)
    receiver.form({std::array{echo::EchoSet{ping.arrivals}}, chirp, kSampling, {}}, ping.sin_beams, wanted, ping.images,
                  ping.memory);
  set_rays(state, ping.arrivals.size());
  state.counters["support"] = chirp.support();
}

BENCHMARK(embree_alone)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(whole_ping)->Args({1, 1})->Args({2, 1})->Args({2, 2})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(whole_ping_in_turns)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime()->MinTime(2.0);
BENCHMARK(trace_part)->Unit(benchmark::kMillisecond);
BENCHMARK(scatterers_part)->Unit(benchmark::kMillisecond);
BENCHMARK(arrivals_part)->Unit(benchmark::kMillisecond);
BENCHMARK(echoes_part)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(long_pulse_beams)->Unit(benchmark::kMillisecond);
BENCHMARK(beams_part)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  check();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}

// Time of one ping on a generated bay: 256 beams, range 75 m.
#include <benchmark/benchmark.h>

#include <cmath>
#include <stdexcept>

#include "components/multibeam/head.h"
#include "components/multibeam/testing/head.h"
#include "components/sonar/tile_set.h"

using namespace ensonify;

namespace {

msg::Tile wavy_tile() {
  msg::Tile tile;
  tile.origin_east_m = tile.origin_north_m = -128.0;
  tile.spacing_m = 0.25;
  tile.height_m = msg::Array<float>({1025, 1025});
  tile.sediment = msg::Array<std::uint8_t>({1025, 1025});
  for (std::size_t row = 0; row < 1025; ++row) {
    for (std::size_t col = 0; col < 1025; ++col) {
      tile.height_m(row, col) =
          static_cast<float>(-25.0 + std::sin(0.05 * col) + 0.3 * std::sin(0.31 * row + 0.2 * col));
    }
  }
  return tile;
}

frames::PoseHistory at_rest() {
  frames::PoseHistory truth(10'000'000'000);
  frames::Pose pose;
  pose.position_enu_m.z() = -1.0;
  truth.push(0, pose);
  truth.push(1'000'000'000, pose);
  return truth;
}

void one_ping(benchmark::State& state) {
  MultibeamConfig config = head_in_plain_water();
  config.quality = 0.01 * static_cast<double>(state.range(0));
  world_of(config).water.wind_speed_mps = state.range(1) == 0 ? 5.0 : 0.0;  // echoes by way of a calm surface
  for (int sector = 0; state.range(2) > 1 && sector < state.range(2); ++sector) {
    config.sectors.push_back({.frequency_hz = config.frequency_hz + 20e3 * sector, .delay_s = 200e-6 * sector});
  }
  config.sample_rate_hz = static_cast<double>(state.range(3)) / config.pulse_length_s;
  const Steering steering = steer(config, config.swath_rad, {});
  const HeadSettings settings = config.start();
  Multibeam head(config, 0);
  TileSet tiles;
  tiles.insert(wavy_tile());
  const auto truth = at_rest();
  PingEvent event{0, SimTime{0}, 75.0};
  Multibeam::Memory memory;
  receive_echoes(head, event, settings, steering, truth, tiles.scene(), memory);
  int rays = 0;
  for (const Echoed& sector : memory.echoed) rays += sector.rays_that_hit;
  if (rays < 20000) throw std::runtime_error("the rays miss the seabed");
  state.counters["rays"] = rays;
  for (auto _ : state) {
    ++event.ping;
    const auto beams = receive_echoes(head, event, settings, steering, truth, tiles.scene(), memory);
    benchmark::DoNotOptimize(beams.front().image.amplitude_upa.data());
  }
}
BENCHMARK(one_ping)
    ->ArgNames({"quality_pct", "calm", "sectors", "per_pulse"})
    ->Args({25, 0, 1, 2})
    ->Args({25, 0, 1, 6})
    ->Args({25, 0, 3, 2})
    ->Args({25, 1, 1, 2})
    ->Args({100, 0, 1, 2})
    ->Args({100, 0, 3, 2})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

void detections(benchmark::State& state) {
  const MultibeamConfig config = head_in_plain_water();
  const Steering steering = steer(config, config.swath_rad, {});
  const HeadSettings settings = config.start();
  Multibeam head(config, 0);
  const Detector detector(config, head.arrays());
  const SoundingMaker maker(config, head.arrays());
  TileSet tiles;
  tiles.insert(wavy_tile());
  const auto truth = at_rest();
  const PingEvent event{0, SimTime{0}, 75.0};
  Multibeam::Memory memory;
  const auto beams = receive_echoes(head, event, settings, steering, truth, tiles.scene(), memory);
  const uncertainty::Navigation navigation = config.uncertainty.unstated();
  const InstrumentPing ping{event, settings, steering, truth, navigation};
  ReliefEstimator relief;
  std::size_t bottoms = 0;
  for (auto _ : state) {
    const Placed placed = maker.place(ping, detector.detect(ping, beams, memory.detection), relief, memory.soundings);
    benchmark::DoNotOptimize(placed.soundings.valid.data());
    bottoms = placed.bottoms.size();
  }
  if (bottoms < 250) throw std::runtime_error("the beams do not detect the seabed");
}
BENCHMARK(detections)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

void insert_tile(benchmark::State& state) {
  const auto tile = wavy_tile();
  for (auto _ : state) {
    TileSet tiles;
    tiles.insert(tile);
    benchmark::DoNotOptimize(tiles.scene().size());
  }
}
BENCHMARK(insert_tile)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();

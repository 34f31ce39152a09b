#pragma once

#include <benchmark/benchmark.h>

#include <cmath>
#include <stdexcept>

#include "components/sonar/testing/config.h"
#include "components/sonar/testing/ping.h"
#include "components/sonar/testing/seabed.h"
#include "components/sonar/tile_set.h"

/// For benchmarks of heads that make a few rows a ping: the time of a whole ping over a wavy seabed about 20 m deep.
namespace ensonify {

/// Water as in the scenario of the bay.
inline World& in_a_breeze(HeadPlace& config) {
  World& world = world_of(config);
  world.water.profile.sound_speed_mps = 1490.0;
  world.water.wind_speed_mps = 3.0;
  return world;
}

/// Range of the strongest sample of an image's first row, m.
inline double strongest_m(const msg::Ping& ping) {
  std::size_t strongest = 0;
  for (std::size_t k = 0; k < ping.amplitude_upa.cols(); ++k) {
    if (ping.amplitude_upa(0, k) > ping.amplitude_upa(0, strongest)) strongest = k;
  }
  return 745.0 * (ping.first_sample_s + static_cast<double>(strongest) * ping.sample_period_s);
}

/// The strongest echo comes from a range between these.
template <class Head>
void time_pings(benchmark::State& state, const typename Head::Config& config, double from_m, double to_m) {
  Head head(config, 0);
  TileSet tiles(config.lod);
  tiles.insert(tile_of(256.0, 0.25, [](double east_m, double north_m) {
    return -20.0 - 0.035 * east_m + 0.1 * std::sin(0.9 * north_m + 0.4 * east_m) + 0.05 * std::sin(2.3 * east_m);
  }));
  frames::PoseHistory truth(10'000'000'000);
  frames::Pose pose;
  pose.position_enu_m.z() = -1.0;
  truth.push(0, pose);
  truth.push(1'000'000'000, pose);
  const HeadSettings settings = config.start();
  const Surroundings sea = around(truth, tiles.scene());
  PingEvent event{0, SimTime{0}, settings.range_m};
  const double range_m = strongest_m(image_of(head, event, settings, sea));
  if (range_m < from_m || range_m > to_m) throw std::runtime_error("the strongest echo comes from elsewhere");
  for (auto _ : state) {
    ++event.ping;
    const msg::Ping ping = image_of(head, event, settings, sea);
    benchmark::DoNotOptimize(ping.amplitude_upa.data());
  }
}

}  // namespace ensonify

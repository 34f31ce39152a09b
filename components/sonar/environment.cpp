#include "components/sonar/environment.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "kernels/acoustics/sea_surface.h"
#include "kernels/water/noise.h"
#include "scenarios/world/seabed.h"

namespace ensonify {
namespace {

constexpr double kSpeedTolerance_mps = 0.01;
constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;

/// For the laws that want pressure. Where the origin comes with a raster, its latitude is not known here; the speed of
/// sound at 1000 m then errs by 0.05 m/s at most.
double latitude_rad(const Site& site) {
  return site.origin_from_raster ? water::kMeanLatitude_rad : site.origin.latitude_deg * kRadiansPerDegree;
}

refraction::SoundSpeedProfile profile_of(const WaterProfile& profile, const World& world) {
  const Water& water = world.water;
  const double latitude = latitude_rad(world.site);
  if (profile.sound_speed_mps) return refraction::SoundSpeedProfile::uniform(*profile.sound_speed_mps);
  if (profile.samples.empty()) {
    return refraction::SoundSpeedProfile::uniform(water::sound_speed_mps(
        water.sound_speed_law, water.temperature_degc, water.salinity_psu, world.mission.depth_m, latitude));
  }
  std::vector<refraction::Knot> knots;
  for (const WaterSample& sample : profile.samples) {
    const double speed_mps =
        sample.sound_speed_mps
            ? *sample.sound_speed_mps
            : water::sound_speed_mps(water.sound_speed_law, sample.temperature_degc.value_or(water.temperature_degc),
                                     sample.salinity_psu.value_or(water.salinity_psu), sample.depth_m, latitude);
    knots.push_back({sample.depth_m, speed_mps});
  }
  return refraction::SoundSpeedProfile(std::move(knots)).thinned(kSpeedTolerance_mps);
}

double noise_level_db_of(const Water& water, double frequency_hz) {
  return water.noise_level_db.value_or(water::ambient_noise_level_db(frequency_hz, water.wind_speed_mps));
}

/// The first sound waits for facets' laws, so they are made side by side.
seabed::ClassTables tables_of(const std::map<std::uint8_t, seabed::Scatterer>& sediments, double frequency_hz,
                              double sound_speed_mps) {
  const std::vector<std::pair<std::uint8_t, seabed::Scatterer>> listed(sediments.begin(), sediments.end());
  std::vector<seabed::Law> of_listed(listed.size());
  tbb::parallel_for(std::size_t{0}, listed.size(), [&](std::size_t i) {
    of_listed[i] = seabed::law_of(listed[i].second, frequency_hz, sound_speed_mps);
  });
  std::vector<seabed::Law> laws(listed.back().first + 1U, of_listed.front());
  for (std::size_t i = 0; i < listed.size(); ++i) laws[listed[i].first] = of_listed[i];
  return seabed::ClassTables(laws);
}

}  // namespace

refraction::SoundSpeedProfile true_profile(const World& world) { return profile_of(world.water.profile, world); }

refraction::SoundSpeedProfile applied_profile(const World& world) {
  const Water& water = world.water;
  return profile_of(water.applied.given() ? water.applied : water.profile, world);
}

water::Column true_column(const Water& water) {
  std::vector<water::SeaWater> samples;
  for (const WaterSample& sample : water.profile.samples) {
    samples.push_back({sample.temperature_degc.value_or(water.temperature_degc),
                       sample.salinity_psu.value_or(water.salinity_psu), sample.depth_m, water.ph});
  }
  if (samples.empty()) samples.push_back({water.temperature_degc, water.salinity_psu, 0.0, water.ph});
  return water::Column(std::move(samples));
}

Environment::Environment(const World& world, double frequency_hz)
    : frequency_hz_(frequency_hz),
      profile_(true_profile(world)),
      applied_(ensonify::applied_profile(world)),
      column_(true_column(world.water)),
      absorption_law_(world.water.absorption_law),
      absorption_dbpm_(world.water.absorption_dbpm),
      noise_level_db_(noise_level_db_of(world.water, frequency_hz)),
      sediments_(world.seabed.sediments),
      backscatter_(std::make_shared<seabed::ClassTables>(
          tables_of(sediments_, frequency_hz, profile_.knots().back().speed_mps))),
      tide_(world.vertical.tide),
      rms_wave_height_m_(surface::rms_wave_height_m(world.water.wind_speed_mps)),
      scattering_layers_(world.water.scattering_layers),
      bubble_loss_db_(world.water.bubble_loss_db) {}

const seabed::ClassTables& Environment::backscatter(std::span<const double> mean_square_slope,
                                                    FacetLaws& memory) const {
  if (mean_square_slope.empty()) return *backscatter_;
  if (memory.of != backscatter_ || !std::ranges::equal(mean_square_slope, memory.mean_square_slope)) {
    memory.of = backscatter_;
    memory.mean_square_slope.assign(mean_square_slope.begin(), mean_square_slope.end());
    memory.tables = tables_of(on_mesh(sediments_, mean_square_slope), frequency_hz_, profile_.knots().back().speed_mps);
  }
  return *memory.tables;
}

double Environment::absorption_dbpm(double from_depth_m, double to_depth_m) const {
  if (absorption_dbpm_) return *absorption_dbpm_;
  return column_.mean_absorption_dbpm(absorption_law_, frequency_hz_, from_depth_m, to_depth_m);
}

}  // namespace ensonify

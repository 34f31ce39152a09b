#include "scenarios/world/water.h"

#include <fmt/format.h>

#include "scenarios/world/cast_file.h"
#include "scenarios/world/sections.h"

namespace ensonify {
namespace {

/// `cast: FILE`, or `cast: { path: FILE, depth_m: "Depth (m)", ... }` with what the columns are called.
std::vector<WaterSample> read_cast_of(ConfigReader& from) {
  std::string path;
  CastColumns columns;
  if (const ConfigNode* node = from.node("cast"); node->is_map()) {
    ConfigReader cast = from.section("cast");
    cast.required_path("path", path);
    cast.optional("depth_m", columns.depth_m);
    cast.optional("sound_speed_mps", columns.sound_speed_mps);
    cast.optional("temperature_degc", columns.temperature_degc);
    cast.optional("salinity_psu", columns.salinity_psu);
  } else {
    from.required_path("cast", path);
  }
  if (path.empty()) return {};
  try {
    return read_cast(path, columns);
  } catch (const ConfigError& error) {
    from.add(error);
    return {};
  }
}

std::vector<WaterSample> read_samples(ConfigReader& from) {
  std::vector<WaterSample> samples;
  for (auto& knot : from.list("profile")) {
    WaterSample sample;
    using namespace sample_limits;
    knot.required("depth_m", sample.depth_m, 0, kDeepest_m);
    knot.optional("sound_speed_mps", sample.sound_speed_mps, kSlowest_mps, kFastest_mps);
    knot.optional("temperature_degc", sample.temperature_degc, kColdest_degc, kWarmest_degc);
    knot.optional("salinity_psu", sample.salinity_psu, 0, kSaltiest_psu);
    if (!knot.has("sound_speed_mps") && !(knot.has("temperature_degc") && knot.has("salinity_psu"))) {
      knot.problem("", "needs sound_speed_mps, or temperature_degc and salinity_psu");
    }
    if (!samples.empty() && knot.has("depth_m") && sample.depth_m <= samples.back().depth_m) {
      knot.problem("depth_m", "is not below the sample before; depths must rise");
    }
    samples.push_back(sample);
  }
  return samples;
}

/// One of sound_speed_mps, profile, cast.
WaterProfile read_profile(ConfigReader& from) {
  WaterProfile profile;
  from.optional("sound_speed_mps", profile.sound_speed_mps, sample_limits::kSlowest_mps, sample_limits::kFastest_mps);
  if (from.has("profile")) profile.samples = read_samples(from);
  if (from.has("cast")) {
    if (from.has("profile")) from.problem("cast", "stands beside profile; give one or the other");
    profile.samples = read_cast_of(from);
  }
  if (from.has("sound_speed_mps") && (from.has("profile") || from.has("cast"))) {
    from.problem("sound_speed_mps", "stands beside a profile or cast; give one or the other");
  }
  return profile;
}

water::ScatteringLayer read_layer(ConfigReader& from) {
  water::ScatteringLayer layer{};
  std::array<double, 2> depths_m{};
  from.required("depth_m", depths_m, 0, sample_limits::kDeepest_m);
  from.required("sv_db", layer.sv_db, -150, 0);
  if (from.has("depth_m") && from.good() && depths_m[0] >= depths_m[1]) {
    from.problem("depth_m", "is not [top, bottom] with the bottom below the top");
  }
  layer.top_depth_m = depths_m[0];
  layer.bottom_depth_m = depths_m[1];
  return layer;
}

/// Warm and salt water at great depth may be beyond what a profile takes.
void check_speeds(const ConfigReader& from, const Water& water, const WaterProfile& profile) {
  using namespace sample_limits;
  for (const WaterSample& sample : profile.samples) {
    if (sample.sound_speed_mps || !sample.temperature_degc || !sample.salinity_psu) continue;
    const double speed_mps =
        water::sound_speed_mps(water.sound_speed_law, *sample.temperature_degc, *sample.salinity_psu, sample.depth_m);
    if (speed_mps < kSlowest_mps || speed_mps > kFastest_mps) {
      from.problem(from.has("cast") ? "cast" : "profile",
                   fmt::format("makes a sound speed of {:.1f} m/s at {} m; allowed: [{}, {}]", speed_mps,
                               sample.depth_m, kSlowest_mps, kFastest_mps));
    }
  }
}

}  // namespace

Water read_water(ConfigReader from) {
  using namespace sample_limits;
  Water water;
  from.optional("temperature_degc", water.temperature_degc, kColdest_degc, kWarmest_degc);
  from.optional("salinity_psu", water.salinity_psu, 0, kSaltiest_psu);
  from.optional("ph", water.ph, 6, 9);
  from.optional_choice("sound_speed_law", water.sound_speed_law,
                       {{"mackenzie", water::SoundSpeedLaw::kMackenzie},
                        {"unesco", water::SoundSpeedLaw::kUnesco},
                        {"del_grosso", water::SoundSpeedLaw::kDelGrosso}});
  water.profile = read_profile(from);
  check_speeds(from, water, water.profile);
  if (auto applied = from.optional_section("applied")) {
    water.applied = read_profile(*applied);
    check_speeds(*applied, water, water.applied);
    if (!applied->has("sound_speed_mps") && !applied->has("profile") && !applied->has("cast")) {
      from.problem("applied", "needs sound_speed_mps, profile or cast");
    }
  }
  from.optional_choice("absorption_law", water.absorption_law,
                       {{"francois_garrison", water::AbsorptionLaw::kFrancoisGarrison},
                        {"ainslie_mccolm", water::AbsorptionLaw::kAinslieMcColm}});
  from.optional("absorption_db_per_km", water.absorption_dbpm, 0, 2000, FileUnit{1e-3});
  from.optional("wind_speed_mps", water.wind_speed_mps, 0, 40);
  from.optional("noise_level_db", water.noise_level_db, -100, 200);
  for (auto& layer : from.list("scattering_layers")) water.scattering_layers.push_back(read_layer(layer));
  from.optional("bubble_loss_db", water.bubble_loss_db, 0, 60);
  return water;
}

}  // namespace ensonify

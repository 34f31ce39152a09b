#include "scenarios/world/water.h"

#include <fmt/format.h>

#include "components/config/config_error.h"
#include "components/config/config_node.h"
#include "components/config/read_parameters.h"
#include "scenarios/world/water_keys.h"

namespace ensonify {

namespace {

WaterProfile profile_of(const NoProfile&) { return {}; }
WaterProfile profile_of(const UniformProfile& uniform) { return {uniform.sound_speed_mps, {}}; }
WaterProfile profile_of(const auto& sampled) { return {{}, sampled.samples}; }
WaterProfile profile_in(const auto& forms) {
  return std::visit([](const auto& form) { return profile_of(form); }, forms);
}

/// One of sound_speed_mps, profile, cast.
void check_alone(const ConfigReader& from) {
  if (from.has("cast") && from.has("profile")) from.problem("cast", "stands beside profile; give one or the other");
  if (from.has("sound_speed_mps") && (from.has("profile") || from.has("cast"))) {
    from.problem("sound_speed_mps", "stands beside a profile or cast; give one or the other");
  }
}

/// Warm and salt water at great depth may be beyond what a profile takes.
void check_speeds(const ConfigReader& from, const std::string& section, water::SoundSpeedLaw law,
                  const WaterProfile& profile) {
  using namespace sample_limits;
  for (const WaterSample& sample : profile.samples) {
    if (sample.sound_speed_mps || !sample.temperature_degc || !sample.salinity_psu) continue;
    const double speed_mps =
        water::sound_speed_mps(law, *sample.temperature_degc, *sample.salinity_psu, sample.depth_m);
    if (speed_mps < kSlowest_mps || speed_mps > kFastest_mps) {
      const ConfigNode& node = section.empty() ? from.node() : *from.node(section);
      from.problem((section.empty() ? "" : section + ".") + (node.find("cast") != nullptr ? "cast" : "profile"),
                   fmt::format("makes a sound speed of {:.1f} m/s at {} m; allowed: [{}, {}]", speed_mps,
                               sample.depth_m, kSlowest_mps, kFastest_mps));
    }
  }
}

}  // namespace

void WaterSample::check(const ConfigReader& from) const {
  if (!from.has("sound_speed_mps") && !(from.has("temperature_degc") && from.has("salinity_psu"))) {
    from.problem("", "needs sound_speed_mps, or temperature_degc and salinity_psu");
  }
}

void SampledProfile::check(const ConfigReader& from) const {
  const auto& given = from.node("profile")->items;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (given[i].find("depth_m") != nullptr && samples[i].depth_m <= samples[i - 1].depth_m) {
      from.problem(fmt::format("profile[{}].depth_m", i), "is not below the sample before; depths must rise");
    }
  }
}

void MeasuredProfile::complete(ConfigReader& from) {
  if (cast.path.empty()) return;
  try {
    samples = read_cast(cast.path, cast.columns);
  } catch (const ConfigError& error) {
    from.add(error);
  }
}

void AppliedProfile::check(const ConfigReader& from) const { check_alone(from); }

void ScatteringLayerKeys::check(const ConfigReader& from) const {
  if (from.has("depth_m") && from.good() && depths_m[0] >= depths_m[1]) {
    from.problem("depth_m", "is not [top, bottom] with the bottom below the top");
  }
}

void WaterKeys::check(const ConfigReader& from) const {
  check_alone(from);
  check_speeds(from, "", values.sound_speed_law, profile_in(profile));
  if (applied) check_speeds(from, "applied", values.sound_speed_law, profile_in(applied->form));
}

Water WaterKeys::water() const {
  Water water = values;
  water.profile = profile_in(profile);
  if (applied) water.applied = profile_in(applied->form);
  for (const ScatteringLayerKeys& layer : scattering_layers) {
    water.scattering_layers.push_back({layer.depths_m[0], layer.depths_m[1], layer.sv_db});
  }
  return water;
}

}  // namespace ensonify

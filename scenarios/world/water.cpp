#include "scenarios/world/water.h"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "components/config/config_error.h"
#include "components/config/config_node.h"
#include "components/config/read_parameters.h"
#include "scenarios/world/cast.h"
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
    read_parameters(cast, columns);
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
    read_parameters(knot, sample);
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
  read_parameters(from, profile);
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

/// One of the scattering layers as a file has it.
struct LayerInFile {
  std::array<double, 2> depths_m{};
  double sv_db = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("depth_m", "m", must(in(0, sample_limits::kDeepest_m)), "[top, bottom]", self.depths_m);
    visit("sv_db", "dB", must(in(-150, 0)), "volume scattering strength re 1/m", self.sv_db);
  }
  void check(const ConfigReader& from) const {
    if (from.has("depth_m") && from.good() && depths_m[0] >= depths_m[1]) {
      from.problem("depth_m", "is not [top, bottom] with the bottom below the top");
    }
  }
};

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

ParameterList profile_list() {
  ParameterList list = parameters_of<WaterProfile>();
  list.push_back(list_info("profile", "samples; linear between them, constant beyond", parameters_of<WaterSample>()));
  ParameterList cast = parameters_of<CastColumns>();
  cast.insert(cast.begin(), file_info("path", "a text file with commas, semicolons or tabs between columns"));
  list.push_back(file_or_info("cast", "a measured profile: its file, or a map with what the columns are called", cast));
  return list;
}

}  // namespace

ParameterList water_list() {
  ParameterList list = parameters_of<Water>();
  for (ParameterInfo& info : profile_list()) list.push_back(std::move(info));
  list.push_back(
      section_info("applied", "the profile that soundings are corrected with; left out: the true one", profile_list()));
  list.push_back(
      list_info("scattering_layers", "layers that scatter sound in the water", parameters_of<LayerInFile>()));
  return list;
}

Water read_water(ConfigReader from) {
  Water water;
  read_parameters(from, water);
  water.profile = read_profile(from);
  check_speeds(from, water, water.profile);
  if (auto applied = from.optional_section("applied")) {
    water.applied = read_profile(*applied);
    check_speeds(*applied, water, water.applied);
    if (!applied->has("sound_speed_mps") && !applied->has("profile") && !applied->has("cast")) {
      from.problem("applied", "needs sound_speed_mps, profile or cast");
    }
  }
  for (auto& item : from.list("scattering_layers")) {
    LayerInFile layer;
    read_parameters(item, layer);
    water.scattering_layers.push_back({layer.depths_m[0], layer.depths_m[1], layer.sv_db});
  }
  return water;
}

}  // namespace ensonify

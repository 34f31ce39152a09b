#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenarios/world/cast.h"
#include "scenarios/world/water.h"

/// `water:` of a scenario as its file has it.
namespace ensonify {

/// The same speed everywhere.
struct UniformProfile {
  double sound_speed_mps = 1500.0;

  static void parameters(auto& self, auto&& visit) {
    visit("sound_speed_mps", "m/s", must(in(sample_limits::kSlowest_mps, sample_limits::kFastest_mps)),
          "sound speed, equal everywhere; instead of a profile or a cast", self.sound_speed_mps);
  }
};

struct SampledProfile {
  std::vector<WaterSample> samples;

  static void parameters(auto& self, auto&& visit) {
    visit("profile", "samples; linear between them, constant beyond", self.samples);
  }
  void check(const ConfigReader& from) const;
};

/// `cast: FILE`, or `cast: { path: FILE, depth_m: "Depth (m)", ... }` with what the columns are called.
struct CastKeys {
  static constexpr const char* kShort = "path";
  std::string path;
  CastColumns columns;

  static void parameters(auto& self, auto&& visit) {
    visit("path", "", must(ensonify::path()), "a text file with commas, semicolons or tabs between columns", self.path);
    CastColumns::parameters(self.columns, visit);
  }
};
struct MeasuredProfile {
  CastKeys cast;
  std::vector<WaterSample> samples;  // of the file

  static void parameters(auto& self, auto&& visit) {
    visit("cast", "a measured profile: its file, or a map with what the columns are called", self.cast);
  }
  void complete(ConfigReader& from);
};

/// Whoever is asked knows it, or computes it.
struct NoProfile {
  static void parameters(auto&, auto&&) {}
};

/// The profile that soundings are corrected with.
struct AppliedProfile {
  std::variant<UniformProfile, SampledProfile, MeasuredProfile> form;

  static void parameters(auto& self, auto&& visit) {
    visit(one_form("needs sound_speed_mps, profile or cast", ""), self.form);
  }
  void check(const ConfigReader& from) const;
};

struct ScatteringLayerKeys {
  std::array<double, 2> depths_m{};
  double sv_db = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("depth_m", "m", must(in(0, sample_limits::kDeepest_m)), "depths of the layer: [top, bottom]", self.depths_m);
    visit("sv_db", "dB", must(in(-150, 0)), "volume scattering strength re 1/m", self.sv_db);
  }
  void check(const ConfigReader& from) const;
};

struct WaterKeys {
  Water values;  // what has one value
  std::variant<UniformProfile, SampledProfile, MeasuredProfile, NoProfile> profile = NoProfile{};
  std::optional<AppliedProfile> applied;
  std::vector<ScatteringLayerKeys> scattering_layers;

  static void parameters(auto& self, auto&& visit) {
    Water::parameters(self.values, visit);
    visit(one_form("", ""), self.profile);
    visit("applied", "the profile that soundings are corrected with; left out: the true one", self.applied);
    visit("scattering_layers", "layers that scatter sound in the water", self.scattering_layers);
  }
  void check(const ConfigReader& from) const;
  Water water() const;
};

}  // namespace ensonify

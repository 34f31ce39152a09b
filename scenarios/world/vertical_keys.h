#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenarios/world/motion_keys.h"
#include "scenarios/world/world.h"

/// `vertical:` of a scenario as its file has it.
namespace ensonify {

inline constexpr double kHighestTide_m = 20.0;
inline constexpr double kFarthestApart_m = 200.0;  // of two datums

struct ConstantTide {
  double constant_m = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("constant_m", "m", must(in(-kHighestTide_m, kHighestTide_m)), "constant level above chart datum",
          self.constant_m);
  }
};
struct TideConstituentKeys : ConstituentKeys {
  double amplitude_m = 0.0;

  static void parameters(auto& self, auto&& visit) {
    ConstituentKeys::parameters(self, visit);
    visit("amplitude_m", "m", must(in(0, kHighestTide_m)), "amplitude, with the nodal factor of the year",
          self.amplitude_m);
  }
};
struct HarmonicTideKeys {
  std::vector<TideConstituentKeys> constituents;
  double mean_m = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("constituents", "harmonic constituents about the mean level", self.constituents);
    visit("mean_m", "m", in(-kHighestTide_m, kHighestTide_m), "mean level above chart datum", self.mean_m);
  }
};
struct GaugeTide {
  std::string gauge;

  static void parameters(auto& self, auto&& visit) {
    visit("gauge", "", must(path()), "readings of a gauge: lines \"2025-06-01T12:00:00Z,1.35\"", self.gauge);
  }
};
struct TideKeys {
  std::variant<ConstantTide, HarmonicTideKeys, GaugeTide> form;

  static void parameters(auto& self, auto&& visit) { visit(one_form("says nothing; give one of {}", ""), self.form); }
  void check(const ConfigReader& from) const;
};

inline Allowed apart() { return in(-kFarthestApart_m, kFarthestApart_m); }
struct GeoidConstant {
  double metres = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("geoid_above_ellipsoid_m", "m", apart(), "height of the geoid, equal everywhere; left out: 0", self.metres);
  }
};
struct GeoidGrid {
  std::string file;

  static void parameters(auto& self, auto&& visit) {
    visit("geoid_above_ellipsoid_grid", "", must(path()),
          "Esri ASCII grid of the geoid's height, in metres of the world", self.file);
  }
};
struct DatumConstant {
  double metres = 0.0;

  static void parameters(auto& self, auto&& visit) {
    visit("datum_above_geoid_m", "m", apart(), "height of chart datum above the geoid, equal everywhere; left out: 0",
          self.metres);
  }
};
struct DatumGrid {
  std::string file;

  static void parameters(auto& self, auto&& visit) {
    visit("datum_above_geoid_grid", "", must(path()),
          "Esri ASCII grid of chart datum's height above the geoid, in metres of the world", self.file);
  }
};
/// Nothing is given.
struct NotApart {
  static void parameters(auto&, auto&&) {}
};

struct VerticalKeys {
  std::optional<TideKeys> tide;
  std::variant<GeoidConstant, GeoidGrid, NotApart> geoid = NotApart{};
  std::variant<DatumConstant, DatumGrid, NotApart> datum = NotApart{};

  static void parameters(auto& self, auto&& visit) {
    visit("tide", "one of constant_m, constituents, gauge", self.tide);
    visit(one_form(), self.geoid);
    visit(one_form(), self.datum);
  }
  /// Reads the files that are named; what is wrong with them is added to `from`.
  Vertical vertical(const ConfigReader& from, double start_unix_s) const;
};

}  // namespace ensonify

#pragma once

#include <optional>
#include <string>
#include <variant>

#include "scenarios/world/seabed.h"

/// A sediment as a scenario's file has it, in one of five ways.
namespace ensonify {

/// Names of sediments: of APL-UW TR 9407, and some of other sources.
Allowed names_of_sediments();

/// What any of the sediments by TR 9407 may have besides.
struct FacetKeys {
  bool capped = false;
  std::optional<double> slope_deg;

  static void parameters(auto& self, auto&& visit) {
    visit("capped", "", any(), "no more than a diffuse reflector returns: for rock above 100 kHz", self.capped);
    visit("facet_slope_deg", "", in(0, 35), "slope of facets in degrees: what of the relief the heights have",
          self.slope_deg);
  }
  seabed::Scatterer of(const seabed::SedimentParameters& sediment) const;
};

struct NamedSediment : FacetKeys {
  std::string name;

  static void parameters(auto& self, auto&& visit) {
    visit("name", "", must(names_of_sediments()), "a sediment of APL-UW TR 9407", self.name);
    FacetKeys::parameters(self, visit);
  }
};
struct GrainSediment : FacetKeys {
  double size_phi = 1.5;

  static void parameters(auto& self, auto&& visit) {
    visit("grain_size_phi", "", must(in(-1, 9)), "the sediment by its mean grain size", self.size_phi);
    FacetKeys::parameters(self, visit);
  }
};
/// The six parameters, within the limits that TR 9407 states.
struct MeasuredSediment : FacetKeys {
  seabed::SedimentParameters six;

  static void parameters(auto& self, auto&& visit) {
    visit("density_ratio", "", must(in(1, 3)), "density of the sediment over the water's", self.six.density_ratio);
    visit("sound_speed_ratio", "", must(in(0.8, 3)), "sound speed of the sediment over the water's",
          self.six.sound_speed_ratio);
    visit("loss", "", must(in(1e-6, 0.1)), "imaginary over real wavenumber in the sediment", self.six.loss);
    visit("volume_parameter", "", must(in(0, 1)), "volume scattering over attenuation cross section",
          self.six.volume_parameter);
    visit("spectral_exponent", "", in(2.4, 3.9), "exponent of the relief spectrum", self.six.spectral_exponent);
    visit("spectral_strength_cm4", "", must(in(1e-9, 1)), "strength of the relief spectrum, in cm^4",
          self.six.spectral_strength_cm4);
    FacetKeys::parameters(self, visit);
  }
};
struct LambertSediment {
  seabed::Lambert lambert;

  static void parameters(auto& self, auto&& visit) {
    // A perfect diffuser has -4.97 dB.
    visit("lambert_mu_db", "dB", must(in(-60, -4.97)), "Lambert's law with this strength at normal incidence",
          self.lambert.mu_db);
  }
};
struct GsabKeys {
  double specular_db = 0.0, diffuse_db = 0.0;
  std::optional<double> transition_db;
  seabed::Gsab curve;  // its widths and exponent

  static void parameters(auto& self, auto&& visit) {
    visit("specular_db", "dB", must(in(-100, 20)), "level at normal incidence", self.specular_db);
    visit("specular_width_deg", "deg", must(in(0.1, 90)), "width of the specular peak", self.curve.specular_width_rad);
    visit("diffuse_db", "dB", must(in(-100, 0)), "level of the diffuse part", self.diffuse_db);
    visit("diffuse_exponent", "", in(0, 20), "exponent of the cosine of incidence; 2 is Lambert's law",
          self.curve.diffuse_exponent);
    visit("transition_db", "dB", in(-100, 20), "level of a shoulder at moderate incidence; left out: none",
          self.transition_db);
    visit("transition_width_deg", "deg", in(0.1, 90), "width of the shoulder at moderate incidence",
          self.curve.transition_width_rad);
  }
};
struct GsabSediment {
  GsabKeys gsab;

  static void parameters(auto& self, auto&& visit) { visit("gsab", "a curve of six numbers", self.gsab); }
};

struct SedimentKeys {
  static constexpr const char* kShort = "name";
  std::variant<NamedSediment, GrainSediment, MeasuredSediment, LambertSediment, GsabSediment> form;

  static void parameters(auto& self, auto&& visit) {
    visit(one_form("needs one of name, grain_size_phi, density_ratio (with the other five), lambert_mu_db, gsab"),
          self.form);
  }
  /// Nothing where the name is none.
  std::optional<seabed::Scatterer> scatterer() const;
};

}  // namespace ensonify

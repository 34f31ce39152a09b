#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace ensonify::seabed {

/// Parameters of a seabed in [APL1994] (section IV). The comment gives the report's letter and its stated
/// limits.
struct SedimentParameters {
  double density_ratio = 0.0;          // rho: sediment / water, 1..3
  double sound_speed_ratio = 0.0;      // nu: sediment / water, 0.8..3
  double loss = 0.0;                   // delta: imaginary / real wavenumber in the sediment, > 0, up to 0.1
  double volume_parameter = 0.0;       // sigma_2: volume scattering / attenuation cross section, 0..1
  double spectral_exponent = 3.25;     // gamma of the relief spectrum W(K) = w_2 K^-gamma, 2.4..3.9, K in rad/cm
  double spectral_strength_cm4 = 0.0;  // w_2, with the reference length h_0 = 1 cm, up to 1

  bool operator==(const SedimentParameters&) const = default;
};

/// Whether the parameters are inside the report's limits (above). Outside, the laws are still evaluated.
bool in_range(const SedimentParameters& sediment);

/// A row of the report's table 2.
struct NamedSediment {
  std::string_view name;
  SedimentParameters parameters;
};

/// The 14 sediments that the report names, from rough rock to clay [APL1994, table 2]; gamma is 3.25 for all.
std::span<const NamedSediment> named_sediments();
/// Other names of some of them, each with the name in the table.
std::span<const std::pair<std::string_view, std::string_view>> other_sediment_names();

/// The named sediment, or nothing. Where a row of the table has several names, each is known: "gravel" is "cobble".
std::optional<SedimentParameters> sediment_of(std::string_view name);

/// Parameters from the mean grain size, in phi units (-log2 of the diameter in mm), for -1..9 [APL1994, eqs 2-10].
///
/// The attenuation in it is Hamilton's fit [Hamilton1972]. The report uses 1528 m/s for water in the loss, and so do
/// we: it gives the rows of its table to the printed digits (w_2 of the finest rows: 0.000518 printed, 0.0005175
/// computed).
/// @throws std::invalid_argument outside -1..9: the fits are not to be continued.
SedimentParameters sediment_of_grain_size(double mean_grain_size_phi);

}  // namespace ensonify::seabed

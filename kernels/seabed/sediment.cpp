#include "kernels/seabed/sediment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace ensonify::seabed {
namespace {

constexpr double kGamma = 3.25;  // the report's, where nothing better is known

//                                    rho     nu      delta    sigma_2  gamma   w_2
constexpr std::array<NamedSediment, 14> kTable{{
    {"rough rock", {2.5, 2.5, 0.01374, 0.002, kGamma, 0.20693}},
    {"rock", {2.5, 2.5, 0.01374, 0.002, kGamma, 0.01862}},
    {"cobble", {2.5, 1.8, 0.01374, 0.002, kGamma, 0.0160}},
    {"sandy gravel", {2.492, 1.3370, 0.01705, 0.002, kGamma, 0.012937}},
    {"very coarse sand", {2.401, 1.3067, 0.01667, 0.002, kGamma, 0.010573}},
    {"coarse sand", {2.231, 1.2503, 0.01638, 0.002, kGamma, 0.006957}},
    {"medium sand", {1.845, 1.1782, 0.01624, 0.002, kGamma, 0.004446}},
    {"fine sand", {1.451, 1.1073, 0.01602, 0.002, kGamma, 0.002715}},
    {"very fine sand", {1.268, 1.0568, 0.01875, 0.002, kGamma, 0.001544}},
    {"coarse silt", {1.195, 1.0179, 0.02158, 0.002, kGamma, 0.000781}},
    {"medium silt", {1.149, 0.9885, 0.00676, 0.001, kGamma, 0.000518}},
    {"fine silt", {1.148, 0.9861, 0.00306, 0.001, kGamma, 0.000518}},
    {"silty clay", {1.146, 0.9824, 0.00163, 0.001, kGamma, 0.000518}},
    {"clay", {1.145, 0.9800, 0.00148, 0.001, kGamma, 0.000518}},
}};

/// Other names of the same rows.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kOtherNames{{
    {"gravel", "cobble"},
    {"pebble", "cobble"},
    {"gravelly sand", "coarse sand"},
    {"silty sand", "fine sand"},
    {"clayey silt", "fine silt"},
}};

double density_ratio(double Mz) {
  if (Mz < 1.0) return 0.007797 * Mz * Mz - 0.17057 * Mz + 2.3139;
  if (Mz < 5.3) return -0.0165406 * Mz * Mz * Mz + 0.2290201 * Mz * Mz - 1.1069031 * Mz + 3.0455;
  return -0.0012973 * Mz + 1.1565;
}

double sound_speed_ratio(double Mz) {
  if (Mz < 1.0) return 0.002709 * Mz * Mz - 0.056452 * Mz + 1.2778;
  if (Mz < 5.3) return -0.0014881 * Mz * Mz * Mz + 0.0213937 * Mz * Mz - 0.1382798 * Mz + 1.3425;
  return -0.0024324 * Mz + 1.0019;
}

/// Attenuation over frequency, dB/m/kHz [Hamilton1972].
double attenuation_over_frequency(double Mz) {
  if (Mz < 0.0) return 0.4556;
  if (Mz < 2.6) return 0.4556 + 0.0245 * Mz;
  if (Mz < 4.5) return 0.1978 + 0.1245 * Mz;
  if (Mz < 6.0) return 8.0399 - 2.5228 * Mz + 0.20098 * Mz * Mz;
  return 0.9431 - 0.2041 * Mz + 0.0117 * Mz * Mz;
}

}  // namespace

bool in_range(const SedimentParameters& sediment) {
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  return within(sediment.density_ratio, 1.0, 3.0) && within(sediment.sound_speed_ratio, 0.8, 3.0) &&
         sediment.loss > 0.0 && sediment.loss <= 0.1 && within(sediment.volume_parameter, 0.0, 1.0) &&
         within(sediment.spectral_exponent, 2.4, 3.9) && sediment.spectral_strength_cm4 > 0.0 &&
         sediment.spectral_strength_cm4 <= 1.0;
}

std::span<const NamedSediment> named_sediments() { return kTable; }
std::span<const std::pair<std::string_view, std::string_view>> other_sediment_names() { return kOtherNames; }

std::optional<SedimentParameters> sediment_of(std::string_view name) {
  for (const auto& [other, row] : kOtherNames) {
    if (name == other) name = row;
  }
  const auto found = std::find_if(kTable.begin(), kTable.end(), [&](const auto& row) { return row.name == name; });
  if (found == kTable.end()) return std::nullopt;
  return found->parameters;
}

SedimentParameters sediment_of_grain_size(double mean_grain_size_phi) {
  const double Mz = mean_grain_size_phi;
  if (!(Mz >= -1.0 && Mz <= 9.0)) {
    throw std::invalid_argument("mean grain size " + std::to_string(Mz) + " phi: allowed is -1 to 9");
  }
  const double nu = sound_speed_ratio(Mz);
  const double water_mpms = 1.528;
  const double h_cm = Mz < 5.0 ? (2.03846 - 0.26923 * Mz) / (1.0 + 0.076923 * Mz) : 0.5;  // rms relief over 1 m
  return {
      .density_ratio = density_ratio(Mz),
      .sound_speed_ratio = nu,
      .loss =
          attenuation_over_frequency(Mz) * nu * water_mpms * std::numbers::ln10 / (40.0 * std::numbers::pi),  // eq. 4
      .volume_parameter = Mz < 5.5 ? 0.002 : 0.001,
      .spectral_exponent = kGamma,
      .spectral_strength_cm4 = 0.00207 * h_cm * h_cm,
  };
}

}  // namespace ensonify::seabed

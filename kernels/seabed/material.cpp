#include "kernels/seabed/material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace ensonify::seabed {
namespace {

constexpr double kSeaWaterMrayl = 1.54;  // 1026 kg/m^3 times 1500 m/s

constexpr std::array<NamedMaterial, 4> kTable{{
    {"rigid", {std::numeric_limits<double>::infinity(), 0.1, 0.0}},
    {"metal", {46.0, 0.1, 0.05}},
    {"concrete", {8.0, 0.2, 0.3}},
    {"wood", {2.9, 0.2, 0.3}},
}};

}  // namespace

std::span<const NamedMaterial> named_materials() { return kTable; }

std::optional<Material> material_of(std::string_view name) {
  const auto found = std::find_if(kTable.begin(), kTable.end(), [&](const auto& row) { return row.name == name; });
  if (found == kTable.end()) return std::nullopt;
  return found->material;
}

double normal_reflection(const Material& material) {
  const double ratio = kSeaWaterMrayl / material.impedance_mrayl;  // 0 for a rigid body
  return (1.0 - ratio) / (1.0 + ratio);
}

double material_backscatter(const Material& material, double grazing_rad) {
  const double theta = std::clamp(grazing_rad, 0.0, std::numbers::pi / 2.0);
  const double reflected = std::pow(normal_reflection(material), 2);
  const double sin_squared = std::pow(std::sin(theta), 2);
  const double slope_squared = std::pow(material.rms_slope, 2);
  const double tan_squared = sin_squared > 0.0 ? (1.0 - sin_squared) / sin_squared : 1e30;  // of incidence
  const double secant_squared = 1.0 + tan_squared;
  const double facets = secant_squared * secant_squared * std::exp(-tan_squared / slope_squared) /
                        (4.0 * std::numbers::pi * slope_squared);
  const double lambert = sin_squared / std::numbers::pi;
  return reflected * ((1.0 - material.diffuse) * facets + material.diffuse * lambert);
}

double lambert_of_target_strength(double target_strength_db, double surface_area_m2) {
  if (!(surface_area_m2 > 0.0)) {
    throw std::invalid_argument("surface area " + std::to_string(surface_area_m2) + " m2: allowed is above 0");
  }
  return 6.0 * std::pow(10.0, 0.1 * target_strength_db) / surface_area_m2;
}

double sphere_target_strength_db(double radius_m) {
  if (!(radius_m > 0.0)) {
    throw std::invalid_argument("radius " + std::to_string(radius_m) + " m: allowed is above 0");
  }
  return 20.0 * std::log10(radius_m / 2.0);
}

}  // namespace ensonify::seabed

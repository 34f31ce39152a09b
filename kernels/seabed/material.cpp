#include "kernels/seabed/material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "kernels/seabed/backscatter.h"

namespace ensonify::seabed {
namespace {

constexpr double kSeaWaterMrayl = 1.54;  // 1026 kg/m^3 times 1500 m/s

constexpr std::array<NamedMaterial, 4> kTable{{
    {"rigid", {std::numeric_limits<double>::infinity(), 0.1, 0.0}},
    {"metal", {46.0, 0.1, 0.05}},
    {"concrete", {8.0, 0.2, 0.3}},
    {"wood", {2.9, 0.2, 0.3}},
}};

void require(bool good, const char* what, double value, const char* allowed) {
  if (!good) throw std::invalid_argument(std::string(what) + " " + std::to_string(value) + ": allowed is " + allowed);
}

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
  require(material.impedance_mrayl > 0.0, "impedance in Mrayl", material.impedance_mrayl, "above 0");
  require(material.rms_slope > 0.0, "rms slope", material.rms_slope, "above 0");
  require(material.diffuse >= 0.0 && material.diffuse <= 1.0, "diffuse share", material.diffuse, "0 to 1");
  const double sine = std::sin(std::clamp(grazing_rad, 0.0, std::numbers::pi / 2.0));
  const double reflected = std::pow(normal_reflection(material), 2);
  const double facets = facet_backscatter(sine, std::pow(material.rms_slope, 2));
  const double lambert = sine * sine / std::numbers::pi;
  return reflected * ((1.0 - material.diffuse) * facets + material.diffuse * lambert);
}

double lambert_of_target_strength(double target_strength_db, double surface_area_m2) {
  require(surface_area_m2 > 0.0, "surface area in m2", surface_area_m2, "above 0");
  return 6.0 * std::pow(10.0, 0.1 * target_strength_db) / surface_area_m2;
}

double sphere_target_strength_db(double radius_m) {
  require(radius_m > 0.0, "radius in m", radius_m, "above 0");
  return 20.0 * std::log10(radius_m / 2.0);
}

}  // namespace ensonify::seabed

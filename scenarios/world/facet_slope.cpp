#include "scenarios/world/facet_slope.h"

#include <cmath>
#include <numbers>

namespace ensonify {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace

seabed::MeshedSediment on_facets(const std::variant<seabed::SedimentParameters, seabed::CappedSediment>& whole,
                                 double facet_slope_deg) {
  const double slope = std::tan(facet_slope_deg * kDegree);
  return {whole, slope * slope};
}

std::map<std::uint8_t, seabed::Scatterer> on_mesh(std::map<std::uint8_t, seabed::Scatterer> sediments,
                                                  std::span<const double> mean_square_slope) {
  for (auto& [number, scatterer] : sediments) {
    if (number >= mean_square_slope.size() || mean_square_slope[number] == 0.0) continue;
    const double slope = mean_square_slope[number];
    if (const auto* plain = std::get_if<seabed::SedimentParameters>(&scatterer)) {
      scatterer = seabed::MeshedSediment{*plain, slope};
    } else if (const auto* capped = std::get_if<seabed::CappedSediment>(&scatterer)) {
      scatterer = seabed::MeshedSediment{*capped, slope};
    }
  }
  return sediments;
}

double facet_slope_deg(const seabed::MeshedSediment& meshed) {
  return std::atan(std::sqrt(meshed.mean_square_slope)) / kDegree;
}

}  // namespace ensonify
